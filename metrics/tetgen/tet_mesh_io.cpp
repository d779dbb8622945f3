#include "metrics/tetgen/tet_mesh_io.h"

#include <array>
#include <string>
#include <string_view>

#include "metrics/tetgen/gmsh.h"
#include "metrics/tetgen/node_ele.h"
#include "metrics/tetgen/vtu.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::metrics {
namespace {

using Path = std::filesystem::path;

/// All three texts are made before the first is written.
void write_node_ele(const Path& path, const TetMesh& mesh) {
  const bool packed = path.extension() == ".gz";
  const auto sibling = [&](const char* ending) {
    const Path name = packed ? Path(path).replace_extension() : path;
    return Path(name).replace_extension(ending).concat(packed ? ".gz" : "");
  };
  const std::string nodes = to_node(mesh);
  const std::string elements = to_ele(mesh);
  const std::string faces = to_face(mesh);
  write_file(sibling(".node"), nodes);
  write_file(sibling(".ele"), elements);
  write_file(sibling(".face"), faces);
}

struct Format {
  std::string_view ending;
  void (*write)(const Path&, const TetMesh&);
};

constexpr std::array<Format, 4> kFormats = {{
    {"vtu", [](const Path& path, const TetMesh& mesh) { write_file(path, to_vtu(mesh)); }},
    {"msh", [](const Path& path, const TetMesh& mesh) { write_file(path, to_gmsh(mesh)); }},
    {"node", write_node_ele},
    {"ele", write_node_ele},
}};

const Format* find_format(const Path& path) {
  for (const Format& format : kFormats)
    if (format_ending(path) == format.ending) return &format;
  return nullptr;
}

}  // namespace

void write_tet_mesh(const Path& path, const TetMesh& mesh) {
  const Format* format = find_format(path);
  if (format == nullptr) throw InvalidInput(path.string() + ": not a format for tetrahedra; known are vtu, msh, node, ele");
  format->write(path, mesh);
}

bool is_tet_mesh_format(const Path& path) {
  return find_format(path) != nullptr;
}

}  // namespace smopt::metrics
