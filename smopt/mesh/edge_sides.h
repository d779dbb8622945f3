#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// One triangle's use of an edge.
struct EdgeSide {
  VertexId low, high;  ///< the edge's ends, low < high
  FaceId face;
  bool is_ascending;  ///< the triangle goes from low to high
};

/// All sides of all edges, sorted by edge and then by triangle, so that the sides of one edge stand together. Triangles with a repeated corner
/// are left out. Cost: O(n log n).
std::vector<EdgeSide> sorted_edge_sides(const TriangleMesh& mesh);

/// Whether a triangle has the same vertex twice.
inline bool has_repeated_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace smopt
