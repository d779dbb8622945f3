#include "smopt/surface/level_set_distance.h"

#include <algorithm>
#include <cmath>

#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Largest step times √d: a third of a kernel's width 0.7/√d.
constexpr double kLongestStepTimesRootDecay = 0.24;

/// A step times √d below which the foot is reached.
constexpr double kArrivedTimesRootDecay = 1e-10;

/// Newton's method doubles its digits with each step; this many steps cross half a dozen kernels as well.
constexpr int kMostSteps = 40;

/// A gradient times 1/√d below which the level set is not in its direction in any useful sense.
constexpr double kLeastSlope = 1e-9;

}  // namespace

std::optional<Vec3> foot_on_level_set(const GaussianField& field, double isovalue, const Vec3& x) {
  const double unit = 1 / std::sqrt(field.decay());
  Vec3 foot = x;
  for (int i = 0; i < kMostSteps; ++i) {
    const FieldJet jet = field.jet(foot);
    const double slope = jet.gradient.norm();
    if (!(slope * unit > kLeastSlope)) return std::nullopt;
    const double wanted = (isovalue - jet.value) / slope;
    const double step = std::clamp(wanted, -kLongestStepTimesRootDecay * unit, kLongestStepTimesRootDecay * unit);
    foot += step / slope * jet.gradient;
    if (std::abs(wanted) <= kArrivedTimesRootDecay * unit) return foot;
  }
  return std::nullopt;
}

LevelSetDistance distance_to_level_set(const GaussianField& field, double isovalue, const std::vector<Vec3>& points) {
  constexpr double kUnresolved = -1;
  std::vector<double> distances(points.size());
  for_ranges_in_parallel(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::optional<Vec3> foot = foot_on_level_set(field, isovalue, points[i]);
      distances[i] = foot ? (*foot - points[i]).norm() : kUnresolved;
    }
  });
  LevelSetDistance sum;
  for (const double distance : distances) {
    sum.unresolved += distance == kUnresolved ? 1 : 0;
    if (distance == kUnresolved) continue;
    sum.largest = std::max(sum.largest, distance);
    sum.mean += distance;
  }
  const std::size_t resolved = points.size() - sum.unresolved;
  if (resolved > 0) sum.mean /= static_cast<double>(resolved);
  return sum;
}

}  // namespace smopt
