#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Keeps the triangles whose flag is not 0, in their order. \pre one flag a triangle.
void keep_triangles(TriangleMesh& mesh, const std::vector<char>& is_kept);

/// Removes the vertices that no triangle uses; the others keep their order. Returns how many were removed.
std::size_t remove_isolated_vertices(TriangleMesh& mesh);

}  // namespace smopt
