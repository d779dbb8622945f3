#pragma once

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// What `isotropic_remeshing` of CGAL 5.5 can be told about a closed surface without constraints; but for the rounds, its own defaults.
struct RemeshingOptions {
  double edge_length = 0;  ///< Å, > 0; longer edges than 4/3 of it are split, shorter ones than 4/5 collapsed
  int rounds = 3;          ///< number_of_iterations; CGAL's default is 1, its example's 3, after which the lengths hardly change
  int relax_rounds = 1;    ///< number_of_relaxation_steps, each round
  bool splits = true;      ///< do_split
  bool collapses = true;   ///< do_collapse
  bool flips = true;       ///< do_flip: towards valence 6
  bool projects = true;    ///< do_project: every vertex goes to the nearest point of its component's initial surface at the end of a round
};

/// Mean length of the edges, Å. \pre closed: each edge has two triangles. Cost: O(n).
double mean_edge_length(const TriangleMesh& mesh);

/// CGAL's `Polygon_mesh_processing::isotropic_remeshing` (Botsch & Kobbelt 2004), over its usual kernel (exact predicates, double positions),
/// in one call, as each call projects to the surface it was given. Nothing keeps the result from intersecting itself. The vertices are new
/// ones, in CGAL's order. CGAL does not tell how far it is: progress says only that it runs, and an interrupt is seen when it next moves
/// vertices. \throws InvalidMesh unless the mesh is a closed, oriented manifold; MethodFailed when CGAL breaks off or nothing is left;
/// Cancelled. Cost: about 15 µs a vertex and round.
void remesh_isotropically(TriangleMesh& mesh, const RemeshingOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt::baselines
