#include "baselines/vertex_target.h"

#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "smopt/mesh/compact.h"

namespace smopt::baselines {
namespace {

/// The tetrahedron has the fewest vertices of all closed surfaces.
constexpr std::size_t kFewestVertices = 4;

std::size_t used_vertices(const std::string& file) {
  TriangleMesh mesh = read_mesh(file);
  remove_isolated_vertices(mesh);
  return mesh.vertex_count();
}

}  // namespace

std::vector<MethodOption> vertex_target_options() {
  using Kind = MethodOption::Kind;
  return {{"vertices", Kind::integer, "0", "", "vertices to aim at; 0: see match", {}},
          {"match", Kind::text, "", "", "a mesh file with as many vertices as to aim at", {}}};
}

std::optional<std::size_t> vertex_target(const OptionValues& values) {
  const auto vertices = static_cast<std::size_t>(values.integer("vertices", 0));
  const std::string& match = values.text("match");
  if (vertices > 0 && !match.empty()) throw InvalidOption("--vertices and --match cannot both be given");
  if (vertices == 0 && match.empty()) return std::nullopt;
  const std::size_t target = vertices > 0 ? vertices : used_vertices(match);
  if (target < kFewestVertices)
    throw InvalidOption(
        fmt::format("--{}: {} vertices; a closed surface has at least {}", vertices > 0 ? "vertices" : "match", target, kFewestVertices));
  return target;
}

}  // namespace smopt::baselines
