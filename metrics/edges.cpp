#include "metrics/edges.h"

#include <algorithm>
#include <tuple>

namespace smopt::metrics {
namespace {

EdgeUse edge_use(const Triangle& t, FaceId face, int side) {
  const VertexId from = t[side];
  const VertexId to = t[(side + 1) % 3];
  return {std::min(from, to), std::max(from, to), face, from < to, static_cast<std::uint8_t>(side)};
}

/// Where the uses of each lower end begin, as in a counting sort: one entry more than there are vertices.
std::vector<std::size_t> first_use_of_low_end(const TriangleMesh& mesh) {
  std::vector<std::size_t> first(mesh.vertex_count() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    if (names_a_vertex_twice(t)) continue;
    for (int side = 0; side < 3; ++side) ++first[std::min(t[side], t[(side + 1) % 3]) + 1];
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) first[v + 1] += first[v];
  return first;
}

}  // namespace

bool names_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh) {
  const std::vector<std::size_t> first = first_use_of_low_end(mesh);
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<EdgeUse> uses(first.back());
  for (std::size_t f = 0; f < mesh.triangle_count(); ++f) {
    if (names_a_vertex_twice(mesh.triangles[f])) continue;
    for (int side = 0; side < 3; ++side) {
      const EdgeUse use = edge_use(mesh.triangles[f], static_cast<FaceId>(f), side);
      uses[next[use.low]++] = use;
    }
  }
  const auto by_high_end = [](const EdgeUse& a, const EdgeUse& b) { return std::tie(a.high, a.face) < std::tie(b.high, b.face); };
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    std::sort(uses.begin() + static_cast<std::ptrdiff_t>(first[v]), uses.begin() + static_cast<std::ptrdiff_t>(first[v + 1]), by_high_end);
  return uses;
}

}  // namespace smopt::metrics
