#include "baselines/iso2mesh/smoothsurf.h"

#include "baselines/hc.h"
#include "baselines/laplacian.h"
#include "baselines/taubin.h"

namespace smopt::baselines {
namespace {

/// μ of its lowpass filter as a multiple of α; its argument beta is ignored there.
constexpr double kMuPerAlpha = -1.02;

/// Its argument beta of laplacianhc, by default.
constexpr double kHcBeta = 0.5;

}  // namespace

std::optional<int> smoothsurf(TriangleMesh& mesh, const SmoothsurfOptions& options, const ProgressCallback& progress) {
  switch (options.method) {
    case SmoothsurfMethod::laplacian:
      return smooth_laplacian(mesh, {options.rounds, options.alpha, SweepOrder::jacobi}, progress);
    case SmoothsurfMethod::lowpass:
      return smooth_taubin(mesh, {options.rounds, options.alpha, kMuPerAlpha * options.alpha}, progress);
    case SmoothsurfMethod::laplacianhc:
      return smooth_hc(mesh, {options.rounds, options.alpha, kHcBeta}, progress);
  }
  return std::nullopt;
}

}  // namespace smopt::baselines
