#pragma once

#include <cstddef>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt {

/// When a vertex of valence 3 or 4 counts as redundant.
struct RedundantPointOptions {
  double tolerance = 1e-4;             ///< distance to the plane (valence 3) or diagonal (valence 4) of the ring; ≥ 0; the paper's `err`
  bool is_tolerance_relative = false;  ///< false: tolerance in Å; true: in units of the longest edge at the vertex
};

struct RedundantPointReport {
  std::size_t valence3 = 0;  ///< vertices of valence 3 removed
  std::size_t valence4 = 0;  ///< vertices of valence 4 removed
  std::size_t refused_link =
      0;  ///< redundant, but removal would break the manifold (a tetrahedron, an existing diagonal, a valence below 3)
  std::size_t refused_meet = 0;  ///< redundant, but a new triangle would intersect, fold over, degenerate or sweep over another triangle
  int passes = 0;                ///< over the vertices, until nothing was removed
};

/// Deletes redundant points (Liu et al. 2017, section 0.2, algorithm 1), to a fixed point.
///
/// A vertex of valence 3 within the tolerance of its ring's plane is replaced by the ring's triangle; one of valence 4 within the tolerance
/// of a diagonal of its ring, with its projection strictly inside the diagonal, by the two triangles along it. What algorithm 1 leaves out
/// is guarded: the link condition, no vertex below valence 3, and for the new triangles and the tetrahedra between them and the old ones
/// the same exact test as for any move. \pre mesh is a closed, oriented manifold. Cost: O(n) and about a microsecond a removal.
RedundantPointReport remove_redundant_points(TriangleMesh& mesh, const RedundantPointOptions& options,
                                             const ProgressCallback& progress = {});

}  // namespace smopt
