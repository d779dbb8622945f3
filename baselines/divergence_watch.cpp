#include "baselines/divergence_watch.h"

#include <algorithm>

namespace smopt::baselines {
namespace {

/// Of the bounding box: a mesh that has left ten of its own diagonals behind is lost, and no smoothing that works comes near it.
constexpr double kDiagonals = 10;

}  // namespace

template <class Point>
DivergenceWatch::Ball DivergenceWatch::allowed_ball(std::span<const Point> start) {
  if (start.empty()) return {};
  Vec3 low = start.front().template cast<double>(), high = low;
  for (const Point& p : start) {
    low = low.cwiseMin(p.template cast<double>());
    high = high.cwiseMax(p.template cast<double>());
  }
  return {(low + high) / 2, kDiagonals * (high - low).norm()};
}

/// "Not within" rather than "beyond", so that a coordinate that is no number counts.
template <class Point>
bool DivergenceWatch::any_outside(std::span<const Point> points) const {
  const double bound = allowed_.radius * allowed_.radius;
  return std::any_of(points.begin(), points.end(),
                     [&](const Point& p) { return !((p.template cast<double>() - allowed_.centre).squaredNorm() <= bound); });
}

DivergenceWatch::DivergenceWatch(std::span<const Vec3> start) : allowed_(allowed_ball(start)) {}

DivergenceWatch::DivergenceWatch(std::span<const Eigen::Vector3f> start) : allowed_(allowed_ball(start)) {}

void DivergenceWatch::look(std::span<const Vec3> points, int step) {
  if (!first_bad_step_ && any_outside(points)) first_bad_step_ = step;
}

void DivergenceWatch::look(std::span<const Eigen::Vector3f> points, int step) {
  if (!first_bad_step_ && any_outside(points)) first_bad_step_ = step;
}

}  // namespace smopt::baselines
