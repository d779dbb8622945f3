#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

enum class MeshlabWeights { cotangent, uniform };

/// The filter's parameters, with its own defaults.
struct MeshlabOptions {
  int rounds = 3;  ///< `stepSmoothNum`; ≥ 0
  MeshlabWeights weights = MeshlabWeights::cotangent;
};

/// MeshLab's filter "Laplacian Smooth" (VCG's VertexCoordLaplacian) on a closed mesh, in float32 as MeshLab computes: every step sets
/// x ← (x + Σ w x_j) / (1 + Σ w) from the last step's positions. Each edge is met from both of its triangles, so that uniform weights are
/// w = 2; cotangent weights are cot α + cot β, signed and unbounded; a vertex whose weights do not sum to more than zero stays. Sums are taken
/// in MeshLab's order, so that results agree with its own to the precision in which it prints.
///
/// Slivers have huge weights of either sign: a vertex is then thrown far away, and the steps go on from there, as in MeshLab.
/// \return the first step that diverged (`DivergenceWatch`), nothing where none did. Same bytes for any number of threads.
/// Cost: about 25 ns a vertex and step with uniform weights, 200 with cotangents. \throws Cancelled.
std::optional<int> smooth_meshlab(TriangleMesh& mesh, const MeshlabOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry.
Method meshlab_method();

}  // namespace smopt::baselines
