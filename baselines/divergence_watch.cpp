#include "baselines/divergence_watch.h"

#include <algorithm>

namespace smopt::baselines {
namespace {

/// Of the bounding box: a mesh that has left ten of its own diagonals behind is lost, and no smoothing that works comes near it.
constexpr double kDiagonals = 10;

}  // namespace

DivergenceWatch::DivergenceWatch(const std::vector<Vec3>& start) {
  if (start.empty()) return;
  Vec3 low = start.front(), high = start.front();
  for (const Vec3& p : start) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  centre_ = (low + high) / 2;
  bound_ = kDiagonals * (high - low).norm();
}

void DivergenceWatch::look(const std::vector<Vec3>& points, int step) {
  if (first_bad_step_) return;
  const double bound = bound_ * bound_;
  // "not within" rather than "beyond", so that a coordinate that is no number counts.
  const bool is_bad = std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return !((p - centre_).squaredNorm() <= bound); });
  if (is_bad) first_bad_step_ = step;
}

}  // namespace smopt::baselines
