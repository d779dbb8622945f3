#pragma once

#include <bit>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/support/files.h"

namespace smopt::testing {

/// Puts a file into the folder, where its path is not asked for.
inline void put_file(const TemporaryFolder& folder, std::string_view name, std::string_view content) {
  static_cast<void>(folder.file(name, content));
}

/// The message of the InvalidInput that `action` throws, its folder left out; empty when it throws nothing.
inline std::string rejection(const std::filesystem::path& folder, const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    std::string message = error.what();
    const std::string prefix = folder.string() + "/";
    for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) message.erase(at, prefix.size());
    return message;
  }
  return {};
}

/// Why a mesh file of that name and content is refused; empty when it is read.
inline std::string mesh_rejection(std::string_view name, std::string_view content) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.file(name, content);
  return rejection(folder.path(), [&] { read_mesh(path); });
}

/// The mesh in a file of that name and content.
inline TriangleMesh mesh_in(std::string_view name, std::string_view content) {
  const TemporaryFolder folder;
  return read_mesh(folder.file(name, content));
}

/// Whether the two have the same triangles and the same positions, bit for bit.
inline bool is_bitwise_equal(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.points.size() != b.points.size() || a.triangles != b.triangles) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (std::bit_cast<std::uint64_t>(a.points[i][k]) != std::bit_cast<std::uint64_t>(b.points[i][k])) return false;
  return true;
}

}  // namespace smopt::testing
