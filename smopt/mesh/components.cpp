#include "smopt/mesh/components.h"

#include <limits>

#include "smopt/mesh/disjoint_sets.h"

namespace smopt {
Components connected_components(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.vertex_count());
  for (const Triangle& t : mesh.triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.vertex_count(), kNone);
  Components components;
  components.of_triangle.reserve(mesh.triangle_count());
  for (const Triangle& t : mesh.triangles) {
    std::uint32_t& component = number[sets.root(t[0])];
    if (component == kNone) component = static_cast<std::uint32_t>(components.count++);
    components.of_triangle.push_back(component);
  }
  return components;
}

}  // namespace smopt
