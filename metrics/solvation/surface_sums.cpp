#include "metrics/solvation/surface_sums.h"

#include <cmath>

#include "smopt/error.h"

namespace smopt::metrics {
namespace {

/// reach³ · accuracy, measured: see the header.
constexpr double kReachCubedByError = 0.08;

/// No cluster is far from another one at this.
constexpr double kNeverFar = 1e-300;
/// For direct sums large leaves are quicker: less is prepared for each pair of them.
constexpr int kDirectLeafSize = 256;

}  // namespace

SurfaceSums surface_sums_for(double accuracy, double kappa, bool is_direct) {
  if (!(accuracy >= 1e-5 && accuracy <= 0.1)) throw InvalidOption("solvation: accuracy must be in [1e-5, 0.1]");
  SurfaceSums sums;
  sums.far = options_for(accuracy, kappa);
  if (is_direct) {
    sums.far.theta = kNeverFar;
    sums.far.leaf_size = kDirectLeafSize;
  }
  sums.reach = std::cbrt(kReachCubedByError / accuracy);
  return sums;
}

}  // namespace smopt::metrics
