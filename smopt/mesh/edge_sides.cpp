#include "smopt/mesh/edge_sides.h"

#include <algorithm>
#include <tuple>

namespace smopt {

std::vector<EdgeSide> sorted_edge_sides(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    const Triangle& t = mesh.triangles[f];
    if (has_repeated_corner(t)) continue;
    for (int i = 0; i < 3; ++i) {
      const VertexId a = t[i], b = t[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const EdgeSide& s, const EdgeSide& t) { return std::tie(s.low, s.high, s.face) < std::tie(t.low, t.high, t.face); });
  return sides;
}

}  // namespace smopt
