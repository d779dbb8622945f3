#pragma once

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// The distance of a point from a surface by CGAL, looking at every triangle.
double distance_from_surface(const Vec3& p, const TriangleMesh& surface);

/// The largest distance of `from` to `to` over a lattice on each triangle, n steps along each edge, corners included: at most the true one,
/// and below it by no more than two thirds of the longest edge over n.
double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int n);

}  // namespace smopt::testing
