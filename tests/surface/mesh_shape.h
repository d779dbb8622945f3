#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

using Corners = std::array<std::array<double, 3>, 3>;

/// The triangles by their corners' places, each from its least corner on, sorted: what stays when vertices and triangles are numbered anew.
inline std::vector<Corners> shape_of(const TriangleMesh& mesh) {
  std::vector<Corners> shape;
  for (const Triangle& triangle : mesh.triangles) {
    Corners& corners = shape.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[triangle[i]];
      corners[i] = {p.x(), p.y(), p.z()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(shape.begin(), shape.end());
  return shape;
}

}  // namespace smopt::testing
