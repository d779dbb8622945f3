#pragma once

#include <vector>

#include "metrics/solvation/discrete_surface.h"

namespace smopt::metrics {

/// A mesh made ready for the solver: without points in no triangle, and turned round as a whole where its volume is negative.
struct SolvableSurface {
  /// \throws InvalidMesh for a mesh that is empty, open, has edges of more than two triangles or triangles that name a vertex twice, is not oriented, or has
  /// coordinates that are not finite, that encloses nothing, or a component of which points the other way than the others: cavities inwards, all else
  /// outwards. Vertices whose triangles form more than one fan are taken. Cost: O(n).
  explicit SolvableSurface(const TriangleMesh& mesh);

  DiscreteSurface surface;
  std::vector<VertexId> vertices;  ///< the mesh's number of each of the surface's vertices
};

}  // namespace smopt::metrics
