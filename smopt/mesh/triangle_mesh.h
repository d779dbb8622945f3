#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

using VertexId = std::uint32_t;
using FaceId = std::uint32_t;

/// The three corners of a triangle, anticlockwise seen from outside.
using Triangle = std::array<VertexId, 3>;

/// A triangle soup that is meant to be a surface: flat arrays, 32-bit indices. Nothing about it is guaranteed but that every index is a
/// point's (the readers and the algorithms see to that); `check_validity` says what it is.
struct TriangleMesh {
  std::vector<Vec3> points;         ///< positions, ångström
  std::vector<Triangle> triangles;  ///< indices into `points`

  [[nodiscard]] std::size_t vertex_count() const { return points.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles.size(); }
};

}  // namespace smopt
