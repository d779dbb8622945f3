#include "metrics/solvation/surface_sums.h"

#include <fmt/format.h>

#include <cmath>

#include "smopt/error.h"

namespace smopt::metrics {
namespace {

/// reach³ · accuracy: the least with which what was measured stays below what is asked.
constexpr double kReachCubedByError = 0.03;

/// No cluster is far from another one at this.
constexpr double kNeverFar = 1e-300;
/// For direct sums large leaves are quicker: less is prepared for each pair of them.
constexpr int kDirectLeafSize = 256;

}  // namespace

SurfaceSums surface_sums_for(double accuracy, double kappa, bool is_direct) {
  if (!(accuracy >= kBestAccuracy && accuracy <= kWorstAccuracy))
    throw InvalidOption(fmt::format("solvation: accuracy must be in [{}, {}]", kBestAccuracy, kWorstAccuracy));
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
