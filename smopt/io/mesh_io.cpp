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
                                                 {"ply", read_one<parse_ply>, write_one<format_ply>},
                                                 {"stl", read_one<parse_stl>, write_one<format_stl>},
                                                 {"obj", read_one<parse_obj>, write_one<format_obj>},
                                                 {"vtp", read_one<parse_vtp>, write_one<format_vtp>},
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

}  // namespace

TriangleMesh read_mesh(const fs::path& path) {
  return require_format(path).read(path);
}

void write_mesh(const fs::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  require_format(path).write(path, mesh, options);
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

}  // namespace smopt
