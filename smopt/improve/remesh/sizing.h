#pragma once

#include <vector>

#include "smopt/improve/remesh/remesh.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// How long edges are to be, and how many vertices that takes.
struct WantedSizes {
  std::vector<double> edges;  ///< per vertex, Å; 0 for a vertex without triangles
  double vertices = 0;
};

/// Finds the sizes that the options ask for. Cost: O(n), all cores.
///
/// density: from the areas of the star's triangles, as if they were equilateral, averaged over some rings so that neighbours differ little.
/// uniform: the edge length that is asked for.
/// curvature: where the curvature is κ, chords of length √(6e/κ − 3e²) stay within e of the surface (Dunyach, Vanderhaeghe, Barthe, Botsch,
/// Adaptive remeshing for real-time mesh deformation, 2013); κ from the normals' change along edges, averaged over some rings; between a quarter
/// and four times the mean density, and growing by no more than three tenths of the distance.
/// Where a number of vertices is asked for, all are scaled so that equilateral triangles of these sizes would be as many as that takes.
WantedSizes find_sizes(const TriangleMesh& mesh, const VertexRings& rings, const RemeshOptions& options);

}  // namespace smopt
