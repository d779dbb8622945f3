#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

struct TaubinOptions {
  int rounds = 100;     ///< pairs of steps; ≥ 0
  double lambda = 0.5;  ///< part of the way to the mean of the neighbours in the first step; MeshLab's default
  double mu = -0.53;    ///< in the second step, back; MeshLab's default. Frequencies below 1/λ + 1/μ pass
};

/// Taubin's λ|μ low-pass filter (Taubin, SIGGRAPH 1995): a round is a Laplacian step of weight λ and one of weight μ < −λ, both Jacobi, with
/// uniform weights. A component of frequency k (an eigenvalue of I − the mean over the neighbours, in [0, 2]) is multiplied by
/// (1 − λk)(1 − μk) each round: those below 1/λ + 1/μ grow slowly (by at most (λ + μ)² / (4λ|μ|), 0.085 % a round by default), those above
/// shrink as long as that product is above −1. Thousands of rounds diverge, therefore, as large λ does.
/// \return the first round that diverged. Vertices without triangles stay. Same bytes for any number of threads. Cost: two Laplacian rounds
/// a round.
std::optional<int> smooth_taubin(TriangleMesh& mesh, const TaubinOptions& options, const ProgressCallback& progress = {});

/// Its entry in the registry.
Method taubin_method();

}  // namespace smopt::baselines
