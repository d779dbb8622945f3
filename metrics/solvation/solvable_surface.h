#pragma once

#include <vector>

#include "metrics/solvation/discrete_surface.h"

namespace smopt::metrics {

/// A mesh made ready for the solver: without points in no triangle, and turned so that its volume is positive.
struct SolvableSurface {
  /// \throws InvalidMesh for a mesh that is empty, open, has edges of more than two triangles or triangles that name a vertex twice, is not oriented, or has
  /// coordinates that are not finite. Vertices whose triangles form more than one fan are taken. Cost: O(n).
  explicit SolvableSurface(const TriangleMesh& mesh);

  DiscreteSurface surface;
  std::vector<VertexId> vertices;  ///< the mesh's number of each of the surface's vertices
};

}  // namespace smopt::metrics
