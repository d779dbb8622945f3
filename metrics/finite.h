#pragma once

#include <algorithm>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Whether all three corners have finite coordinates.
inline bool has_finite_corners(const TriangleMesh& mesh, const Triangle& t) {
  return mesh.points[t[0]].allFinite() && mesh.points[t[1]].allFinite() && mesh.points[t[2]].allFinite();
}

/// Whether every triangle has; vertices in no triangle do not matter.
inline bool has_finite_triangles(const TriangleMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) { return has_finite_corners(mesh, t); });
}

}  // namespace smopt::metrics
