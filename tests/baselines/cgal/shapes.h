#pragma once

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// A pyramid that stands on its apex, (0, 0, −2), with the square [−1, 1]² as its flat roof; vertex 0 lies in the roof, at (x, y, 0), joined
/// to the corners 1..4, which go round anticlockwise from (1, 1, 0).
inline TriangleMesh roofed_pyramid(double x, double y) {
  return {{{x, y, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, -2}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}}};
}

/// Largest distance between corresponding points.
inline double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double far = 0;
  for (std::size_t v = 0; v < a.size(); ++v) far = std::max(far, (a[v] - b[v]).norm());
  return far;
}

}  // namespace smopt::testing
