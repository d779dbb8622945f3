#pragma once

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

struct TangentialOptions {
  int rounds = 10;  ///< number_of_iterations; CGAL's default is 1, its example's 10
};

/// CGAL's `Polygon_mesh_processing::tangential_relaxation` (5.5): every vertex to the mean of its neighbours, without the part along its
/// normal, halved up to five times where the triangles around it would fold; all from the last round's positions. One call a round, which
/// is what one call for all does, as nothing is kept from a round to the next. Surface_mesh over doubles with exact predicates; the
/// triangles do not change. \throws InvalidMesh unless the mesh is a closed, oriented manifold; MethodFailed when CGAL breaks off;
/// Cancelled. Cost: about 1 µs a vertex and round.
void relax_tangentially(TriangleMesh& mesh, const TangentialOptions& options, const ProgressCallback& progress = {});

/// `cgal_tangential` of the registry.
Method tangential_method();

}  // namespace smopt::baselines
