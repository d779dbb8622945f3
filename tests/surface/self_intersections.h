#pragma once

#include <cstddef>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// Pairs of triangles of a closed manifold that meet elsewhere than in a shared vertex or edge, and degenerate triangles, counted by CGAL.
std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace smopt::testing
