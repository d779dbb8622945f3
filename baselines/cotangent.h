#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

struct CotangentOptions {
  int rounds = 100;   ///< ≥ 0
  double beta = 0.5;  ///< part of the way to the weighted mean of the neighbours; pmp-library's explicit smoothing: 0.5
};

/// Laplacian smoothing with clamped cotangent weights in double precision: x ← (1 − β) x + β · Σ w x_j / Σ w with w = max(0, cot α + cot β),
/// each cotangent within ±19.1 (that of 3°), taken anew each round; Jacobi. A triangle without area weighs nothing. Clamped as pmp-library
/// does (Sieger, Botsch, 2020). With weights that are never negative and β ≤ 1 a vertex stays within the hull of its neighbours, so that no
/// sliver throws it. \return the first round that diverged, for β > 1.
/// A vertex whose weights are all zero stays. \pre mesh is a closed, oriented manifold, otherwise throws
/// InvalidMesh. Same bytes for any number of threads. Cost: about 70 ns a vertex and round.
std::optional<int> smooth_cotangent(TriangleMesh& mesh, const CotangentOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry: clamped in double, or as MeshLab in float32 (`smooth_meshlab`).
Method cotangent_method();

}  // namespace smopt::baselines
