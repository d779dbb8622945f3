#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// One side of one triangle, seen as a use of the undirected edge low–high.
struct EdgeUse {
  VertexId low;       ///< the smaller end
  VertexId high;      ///< the larger end
  FaceId face;        ///< the triangle
  bool forward;       ///< the triangle runs from low to high
  std::uint8_t side;  ///< the side runs from corner `side` to corner `side + 1` (mod 3)
};

/// Whether the triangle names a vertex twice: such a face has no three sides and takes part in no edge.
bool names_a_vertex_twice(const Triangle& triangle);

/// The sides of all triangles, sorted by (low, high, face), so that the uses of one edge follow each other.
/// Works on any soup: an edge may have any number of uses. Cost: O(n log(valence)).
std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh);

/// Calls `visit(std::span<const EdgeUse>)` once for every undirected edge, with all its uses.
template <class Visitor>
void for_each_edge(std::span<const EdgeUse> uses, Visitor&& visit) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
    visit(uses.subspan(begin, end - begin));
  }
}

}  // namespace smopt::metrics
