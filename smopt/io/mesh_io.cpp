#include "smopt/io/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/msms.h"
#include "smopt/io/obj.h"
#include "smopt/io/off.h"
#include "smopt/io/ply.h"
#include "smopt/io/stl.h"
#include "smopt/io/vtp.h"

namespace smopt {
namespace {

namespace fs = std::filesystem;

struct MeshFormat {
  std::string_view ending;
  TriangleMesh (*read)(const fs::path& path);
  void (*write)(const fs::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options);
  std::string (*format_with_scalars)(const TriangleMesh& mesh, std::span<const VertexScalars> scalars) = nullptr;
};

/// A format whose mesh is one file.
template <TriangleMesh (*parse)(std::string_view, const std::string&)>
TriangleMesh read_one(const fs::path& path) {
  return parse(read_file(path), display_name(path));
}
template <std::string (*format)(const TriangleMesh&, const MeshWriteOptions&)>
void write_one(const fs::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  write_file(path, format(mesh, options));
}

constexpr std::array<MeshFormat, 7> kFormats = {{{"off", read_one<parse_off>, write_one<format_off>},
                                                 {"ply", read_one<parse_ply>, write_one<format_ply>, format_ply_with_scalars},
                                                 {"stl", read_one<parse_stl>, write_one<format_stl>},
                                                 {"obj", read_one<parse_obj>, write_one<format_obj>},
                                                 {"vtp", read_one<parse_vtp>, write_one<format_vtp>, format_vtp_with_scalars},
                                                 {"vert", read_msms, write_msms},
                                                 {"face", read_msms, write_msms}}};

const MeshFormat* find_format(const fs::path& path) {
  const auto found = std::ranges::find(kFormats, format_ending(path), &MeshFormat::ending);
  return found == kFormats.end() ? nullptr : &*found;
}

const MeshFormat& require_format(const fs::path& path) {
  const MeshFormat* format = find_format(path);
  if (!format)
    throw InvalidInput(fmt::format("{}: not a mesh format by its name; known are {} (each also .gz)", path.string(), mesh_format_names()));
  return *format;
}

bool is_name_of_scalars(std::string_view name) {
  const auto is_name_character = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::ranges::all_of(name, is_name_character) && name != "x" && name != "y" && name != "z";
}

void require_scalars(const TriangleMesh& mesh, std::span<const VertexScalars> scalars) {
  for (const VertexScalars& s : scalars) {
    if (!is_name_of_scalars(s.name)) throw InvalidOption(fmt::format("\"{}\" cannot be the name of numbers at the vertices", s.name));
    if (std::ranges::count(scalars, s.name, &VertexScalars::name) > 1) throw InvalidOption(fmt::format("{} is there twice", s.name));
    if (s.values.size() != mesh.points.size())
      throw InvalidOption(fmt::format("{} has {} values for {} vertices", s.name, s.values.size(), mesh.points.size()));
  }
}

}  // namespace

TriangleMesh read_mesh(const fs::path& path) {
  return require_format(path).read(path);
}

void write_mesh(const fs::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  require_format(path).write(path, mesh, options);
}

void write_mesh_with_scalars(const fs::path& path, const TriangleMesh& mesh, std::span<const VertexScalars> scalars) {
  const MeshFormat& format = require_format(path);
  if (!format.format_with_scalars)
    throw InvalidInput(fmt::format("{}: {} does not hold numbers at the vertices; these do: {} (each also .gz)", path.string(),
                                   format.ending, scalar_mesh_format_names()));
  require_scalars(mesh, scalars);
  write_file(path, format.format_with_scalars(mesh, scalars));
}

bool is_scalar_mesh_format(const fs::path& path) {
  const MeshFormat* format = find_format(path);
  return format && format->format_with_scalars;
}

bool is_readable_mesh_format(const fs::path& path) {
  return find_format(path) != nullptr;
}
bool is_writable_mesh_format(const fs::path& path) {
  return find_format(path) != nullptr;
}

std::string mesh_format_names() {
  return "off, ply, stl, obj, vtp, vert/face";
}

std::string scalar_mesh_format_names() {
  std::string names;
  for (const MeshFormat& format : kFormats)
    if (format.format_with_scalars) names += fmt::format("{}{}", names.empty() ? "" : ", ", format.ending);
  return names;
}

}  // namespace smopt
