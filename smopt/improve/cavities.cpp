#include "smopt/improve/cavities.h"

#include <cmath>

#include "smopt/mesh/compact.h"
#include "smopt/mesh/nesting.h"
#include "smopt/mesh/orientation.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

enum class Kind { outer, cavity, island };

Kind kind_of(std::uint32_t depth) {
  return depth == 0 ? Kind::outer : (depth % 2 == 1 ? Kind::cavity : Kind::island);
}

std::uint32_t largest_outer_component(const TriangleMesh& mesh, const Components& components, const Nesting& nesting) {
  const std::vector<double> volumes = component_volumes(mesh, components);
  std::uint32_t largest = 0;
  double largest_volume = -1;
  for (std::uint32_t i = 0; i < components.count; ++i) {
    if (nesting.depth[i] != 0 || std::abs(volumes[i]) <= largest_volume) continue;
    largest = i;
    largest_volume = std::abs(volumes[i]);
  }
  return largest;
}

std::vector<char> kept_components(const TriangleMesh& mesh, const Components& components, const Nesting& nesting, CavityPolicy policy) {
  std::vector<char> is_kept(components.count, 0);
  for (std::uint32_t i = 0; i < components.count; ++i) is_kept[i] = nesting.depth[i] == 0 ? 1 : 0;
  if (policy == CavityPolicy::main && components.count > 0) {
    is_kept.assign(components.count, 0);
    is_kept[largest_outer_component(mesh, components, nesting)] = 1;
  }
  return is_kept;
}

/// Vertices of each component.
std::vector<std::size_t> count_vertices(const Components& components) {
  std::vector<std::size_t> count(components.count, 0);
  for (const std::uint32_t i : components.of_vertex)
    if (i != Components::kNone) ++count[i];
  return count;
}

void keep_components(TriangleMesh& mesh, const Components& components, const std::vector<char>& is_kept) {
  std::vector<char> is_triangle_kept(mesh.triangle_count());
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) is_triangle_kept[f] = is_kept[components.of_triangle[f]];
  });
  keep_triangles(mesh, is_triangle_kept);
  remove_isolated_vertices(mesh);
}

}  // namespace

CavityReport remove_cavities(TriangleMesh& mesh, CavityPolicy policy) {
  return remove_cavities(mesh, connected_components(mesh), policy);
}

CavityReport remove_cavities(TriangleMesh& mesh, const Components& components, CavityPolicy policy) {
  CavityReport report;
  report.components = components.count;
  if (policy == CavityPolicy::keep || components.count <= 1) return report;
  const Nesting nesting = component_nesting(mesh, components);
  const std::vector<char> is_kept = kept_components(mesh, components, nesting, policy);
  const std::vector<std::size_t> vertices = count_vertices(components);
  for (std::uint32_t i = 0; i < components.count; ++i) {
    if (is_kept[i] != 0) continue;
    const Kind kind = kind_of(nesting.depth[i]);
    (kind == Kind::outer ? report.outer_components : kind == Kind::cavity ? report.cavities : report.islands) += 1;
    (kind == Kind::outer ? report.outer_component_vertices : report.cavity_vertices) += vertices[i];
  }
  keep_components(mesh, components, is_kept);
  return report;
}

}  // namespace smopt
