#include "metrics/tetgen/shells.h"

#include <cmath>
#include <span>

#include "metrics/edges.h"
#include "metrics/union_find.h"

namespace smopt::metrics {
namespace {

struct Neighbor {
  FaceId face;
  bool same_way;  ///< the two run through their edge in opposite directions, as neighbours should
};

class ShellFinder {
 public:
  explicit ShellFinder(const TriangleMesh& mesh) : mesh_(mesh), uses_(edge_uses(mesh)), turned_(mesh.triangle_count(), 0) {}

  Shells run() {
    number_shells();
    turn_consistently();
    find_volumes();
    return std::move(shells_);
  }

 private:
  void number_shells() {
    UnionFind sets(mesh_.triangle_count());
    for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
      for (const EdgeUse& use : edge) sets.unite(edge.front().face, use.face);
    });
    std::vector<std::uint32_t> number(mesh_.triangle_count());
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < mesh_.triangle_count(); ++f) {
      if (sets.root(f) == f) number[f] = count++;
      shells_.of_triangle.push_back(number[sets.root(f)]);
    }
    shells_.volume.resize(count);
  }

  /// Spreads the orientation of the first triangle of each shell over edges with two triangles.
  void turn_consistently() {
    const std::vector<std::vector<Neighbor>> neighbors = neighbors_over_edges();
    std::vector<bool> seen(mesh_.triangle_count(), false);
    for (std::size_t seed = 0; seed < mesh_.triangle_count(); ++seed) {
      if (seen[seed]) continue;
      seen[seed] = true;
      std::vector<std::size_t> stack = {seed};
      while (!stack.empty()) {
        const std::size_t f = stack.back();
        stack.pop_back();
        for (const Neighbor& n : neighbors[f]) {
          if (seen[n.face]) continue;
          seen[n.face] = true;
          turned_[n.face] = n.same_way ? turned_[f] : !turned_[f];
          stack.push_back(n.face);
        }
      }
    }
  }

  [[nodiscard]] std::vector<std::vector<Neighbor>> neighbors_over_edges() const {
    std::vector<std::vector<Neighbor>> neighbors(mesh_.triangle_count());
    for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
      if (edge.size() != 2) return;
      const bool same_way = edge[0].forward != edge[1].forward;
      neighbors[edge[0].face].push_back({edge[1].face, same_way});
      neighbors[edge[1].face].push_back({edge[0].face, same_way});
    });
    return neighbors;
  }

  void find_volumes() {
    std::vector<double> sixfold(shells_.volume.size(), 0.0);
    std::vector<Vec3> origin(shells_.volume.size(), Vec3::Constant(std::nan("")));
    for (std::size_t f = 0; f < mesh_.triangle_count(); ++f) {
      const auto& [a, b, c] = mesh_.triangles[f];
      Vec3& o = origin[shells_.of_triangle[f]];
      if (!o.allFinite()) o = mesh_.points[a];
      const double cone = (mesh_.points[a] - o).dot((mesh_.points[b] - o).cross(mesh_.points[c] - o));
      sixfold[shells_.of_triangle[f]] += turned_[f] != 0 ? -cone : cone;
    }
    const std::vector<bool> closed = which_are_closed();
    for (std::size_t s = 0; s < sixfold.size(); ++s)
      if (closed[s]) shells_.volume[s] = std::abs(sixfold[s]) / 6;
  }

  /// Closed and consistent: each edge is run through as often in one direction as in the other.
  [[nodiscard]] std::vector<bool> which_are_closed() const {
    std::vector<bool> closed(shells_.volume.size(), true);
    for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
      std::size_t forward = 0;
      for (const EdgeUse& use : edge)
        if (use.forward != (turned_[use.face] != 0)) ++forward;
      if (2 * forward != edge.size()) closed[shells_.of_triangle[edge.front().face]] = false;
    });
    return closed;
  }

  const TriangleMesh& mesh_;
  std::vector<EdgeUse> uses_;
  std::vector<char> turned_;
  Shells shells_;
};

}  // namespace

Shells find_shells(const TriangleMesh& mesh) {
  return ShellFinder(mesh).run();
}

}  // namespace smopt::metrics
