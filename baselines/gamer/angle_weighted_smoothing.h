#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// The defaults are those of `smooth` in GAMer 2's Python interface.
struct AngleWeightedOptions {
  int rounds = 6;        ///< its max_iter; ≥ 0
  int tensor_rings = 2;  ///< its rings: neighbourhood whose normals damp a vertex's move; ≥ 1
  bool has_flips = true;
};

struct AngleWeightedReport {
  std::size_t flipped_edges = 0;
  std::optional<int> diverged_at_step;
};

/// GAMer 2's `smoothMesh` (Lee et al. 2020, after Yu et al. 2008): in every round an `angle_weighted_step`, then `flip_edges`. No test for
/// intersections. \throws InvalidMesh unless the mesh is a closed, oriented manifold; Cancelled. Vertices without triangles stay. Same bytes
/// for any number of threads. Cost: about a microsecond a vertex and round.
AngleWeightedReport smooth_angle_weighted(TriangleMesh& mesh, const AngleWeightedOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry, `gamer`.
Method gamer_method();

}  // namespace smopt::baselines
