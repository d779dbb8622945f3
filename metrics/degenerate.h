#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// For each triangle whether its corners lie exactly on one line (or in one point), decided with CGAL's exact predicates. A triangle with a
/// corner that is not finite is not degenerate: nothing is known about it. Cost: O(n).
std::vector<bool> degenerate_triangles(const TriangleMesh& mesh);

}  // namespace smopt::metrics
