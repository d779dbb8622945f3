#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

struct HcOptions {
  int rounds = 100;   ///< ≥ 0
  double alpha = 0;   ///< weight of the original positions against the last round's in what is pushed back to; ≥ 0; MeshLab: 0
  double beta = 0.5;  ///< weight of the vertex's own push against its neighbours'; ≥ 0; MeshLab and ISO2mesh: 0.5
};

/// The HC algorithm (Vollmer, Mencl, Müller, Improved Laplacian smoothing of noisy surface meshes, Comput. Graph. Forum 18:131, 1999), Jacobi:
/// q = p; p = mean of the neighbours' q; b = p − (α·o + (1 − α)·q) with the original positions o; p ← p − (β·b + (1 − β)·mean of the
/// neighbours' b). With β = 1 nothing moves. \return the first round that diverged. Vertices without triangles stay. Same bytes for
/// any number of threads. Cost: two Laplacian rounds a round.
std::optional<int> smooth_hc(TriangleMesh& mesh, const HcOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry.
Method hc_method();

}  // namespace smopt::baselines
