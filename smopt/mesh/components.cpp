#include "smopt/mesh/components.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Union–find that all threads work on at once: a link always leads to a smaller index and is set by compare-and-swap (Jayanti and Tarjan
/// 2016), so the root of a set is its smallest index whatever the threads did in between.
class SharedDisjointSets {
 public:
  explicit SharedDisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return std::atomic_ref(parent_[i]).load(std::memory_order_relaxed); }

  /// The root, which every element passed on the way is linked to more directly.
  std::uint32_t root(std::uint32_t i) {
    for (std::uint32_t p = parent(i); p != i; p = parent(i)) {
      const std::uint32_t above = parent(p);
      if (above != p) std::atomic_ref(parent_[i]).store(above, std::memory_order_relaxed);
      i = above;
    }
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) {
    for (;;) {
      i = root(i);
      j = root(j);
      if (i == j) return;
      if (i < j) std::swap(i, j);
      std::uint32_t expected = i;
      if (std::atomic_ref(parent_[i]).compare_exchange_strong(expected, j, std::memory_order_relaxed)) return;
    }
  }

  void link_to_root(std::uint32_t i) { std::atomic_ref(parent_[i]).store(root(i), std::memory_order_relaxed); }

 private:
  mutable std::vector<std::uint32_t> parent_;
};

/// The vertices as sets by component, each linked to its root.
SharedDisjointSets connected_vertices(const TriangleMesh& mesh) {
  SharedDisjointSets sets(mesh.vertex_count());
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& t = mesh.triangles[f];
      sets.unite(t[0], t[1]);
      sets.unite(t[0], t[2]);
    }
  });
  for_ranges_in_parallel(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) sets.link_to_root(static_cast<VertexId>(v));
  });
  return sets;
}

/// The number of the component with each root, in the order of the first triangles.
std::vector<std::uint32_t> number_roots(const TriangleMesh& mesh, const SharedDisjointSets& sets, std::size_t& count) {
  std::vector<std::uint32_t> number(mesh.vertex_count(), Components::kNone);
  std::uint32_t last = Components::kNone;
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t root = sets.parent(t[0]);
    if (root != last && number[root] == Components::kNone) number[root] = static_cast<std::uint32_t>(count++);
    last = root;
  }
  return number;
}

}  // namespace

Components connected_components(const TriangleMesh& mesh) {
  const SharedDisjointSets sets = connected_vertices(mesh);
  Components components;
  components.of_vertex = number_roots(mesh, sets, components.count);
  // A root is smaller than what it is the root of: from the end, no number is overwritten before it is read.
  for (std::size_t v = mesh.vertex_count(); v-- > 0;) components.of_vertex[v] = components.of_vertex[sets.parent(static_cast<VertexId>(v))];
  components.of_triangle.resize(mesh.triangle_count());
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) components.of_triangle[f] = components.of_vertex[mesh.triangles[f][0]];
  });
  return components;
}

}  // namespace smopt
