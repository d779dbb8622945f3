#include "smopt/mesh/components.h"

#include <limits>
#include <numeric>

namespace smopt {
namespace {

/// Union–find with path halving; the smaller index becomes the root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

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
