#pragma once

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

struct ShapeOptions {
  int rounds = 10;     ///< number_of_iterations; CGAL's default is 1, its example's 10
  double time = 1e-4;  ///< time step, Å²; > 0; CGAL has no default: its example's
};

/// CGAL's `Polygon_mesh_processing::smooth_shape`: implicit mean curvature flow with the stiffness of the initial mesh and the mass of each
/// round's (Kazhdan, Solomon & Ben-Chen 2012), its equations solved by Eigen's BiCGSTAB with an incomplete LU factorisation, CGAL's own
/// choice. One call for all rounds, as the stiffness is taken at its start. CGAL (5.5) then scales a closed mesh, as a whole about its
/// centroid, to the volume it had. Nothing keeps it from intersecting itself.
/// \return the rounds that CGAL made: it stops without a word when its solver fails. \throws InvalidMesh unless the mesh is a closed,
/// oriented manifold; MethodFailed when the first round fails or a coordinate is not finite; Cancelled, between the solutions of two
/// rounds. Cost: about 2 µs a vertex and round, more for a longer time.
int smooth_shape(TriangleMesh& mesh, const ShapeOptions& options, const ProgressCallback& progress = {});

/// `cgal_shape` of the registry.
Method shape_method();

}  // namespace smopt::baselines
