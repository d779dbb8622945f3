#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// Whether a round uses the positions of the round before (Jacobi) or those already moved in it (Gauss–Seidel, in ascending order).
enum class SweepOrder { jacobi, gauss_seidel };

struct LaplacianOptions {
  int rounds = 100;  ///< sweeps over all vertices; ≥ 0
  double beta = 1;   ///< part of the way to the mean of the neighbours; the paper: 1
  SweepOrder order = SweepOrder::jacobi;
};

/// Plain Laplacian smoothing, x ← (1 − β) x + β · mean of the one-ring (Liu et al. 2017, equations 3 and 4): every vertex, every round, no
/// test of any kind and no rule for borders. Vertices without triangles stay. \return the first round that diverged (`DivergenceWatch`; it
/// takes β > 1). Same bytes for any number of threads; Gauss–Seidel uses one. Cost: 5 to 6 ns a
/// vertex and round, 11 in Gauss–Seidel order.
std::optional<int> smooth_laplacian(TriangleMesh& mesh, const LaplacianOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry.
Method laplacian_method();

}  // namespace smopt::baselines
