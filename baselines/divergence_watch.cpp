#include "baselines/divergence_watch.h"

#include <algorithm>

namespace smopt::baselines {
namespace {

/// Of the bounding box: a mesh that has left ten of its own diagonals behind is lost, and no smoothing that works comes near it.
constexpr double kDiagonals = 10;

/// A ball around the centre of a box.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

template <class Point>
Ball allowed_ball(std::span<const Point> start) {
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
bool any_outside(std::span<const Point> points, const Vec3& centre, double radius) {
  const double bound = radius * radius;
  return std::any_of(points.begin(), points.end(),
                     [&](const Point& p) { return !((p.template cast<double>() - centre).squaredNorm() <= bound); });
}

}  // namespace

DivergenceWatch::DivergenceWatch(std::span<const Vec3> start) : centre_(allowed_ball(start).centre), radius_(allowed_ball(start).radius) {}

DivergenceWatch::DivergenceWatch(std::span<const Eigen::Vector3f> start)
    : centre_(allowed_ball(start).centre), radius_(allowed_ball(start).radius) {}

void DivergenceWatch::look(std::span<const Vec3> points, int step) {
  if (!first_bad_step_ && any_outside(points, centre_, radius_)) first_bad_step_ = step;
}

void DivergenceWatch::look(std::span<const Eigen::Vector3f> points, int step) {
  if (!first_bad_step_ && any_outside(points, centre_, radius_)) first_bad_step_ = step;
}

}  // namespace smopt::baselines
