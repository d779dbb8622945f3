#pragma once

#include <optional>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

enum class SmoothsurfMethod { laplacian, lowpass, laplacianhc };

/// The arguments of ISO2mesh's `smoothsurf` that have an effect, with its defaults but for the rounds, which are the paper's.
struct SmoothsurfOptions {
  SmoothsurfMethod method = SmoothsurfMethod::laplacian;
  int rounds = 100;    ///< ≥ 0
  double alpha = 0.5;  ///< ≥ 0
};

/// ISO2mesh's `smoothsurf` (Fang, Boas, IEEE ISBI 2009), all three methods Jacobi with uniform weights and without any rule for borders:
/// laplacian moves α of the way to the mean of the neighbours; lowpass is Taubin's filter with λ = α and μ = −1.02 α; laplacianhc is HC with
/// α and β = 0.5. \return the first round that diverged. Cost: as `smooth_laplacian`, `smooth_taubin` and `smooth_hc`.
std::optional<int> smoothsurf(TriangleMesh& mesh, const SmoothsurfOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt::baselines
