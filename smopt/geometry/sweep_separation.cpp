#include "smopt/geometry/sweep_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smopt {
namespace {

/// Projections in single precision of points no farther than R on an axis: rounding of the coordinates, the products and the sums stays below
/// 6·2⁻²⁴ R |axis|₁ for each side, 7.2e-7 together; rounded up.
constexpr float kMarginRel = 1e-6F;
/// Keeps the margin above what products may lose by underflow.
constexpr float kMarginAbs = 64 * std::numeric_limits<float>::min();

}  // namespace

void SweepSeparation::set_star(const std::vector<Vec3>& ring) {
  size_ = ring.size();
  const std::size_t chunks = (size_ + kLanes - 1) / kLanes;
  ring_.assign(chunks, Points{});
  ring_next_.assign(chunks, Points{});
  ring_radius_ = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    const Eigen::Vector3f p = ring[k].cast<float>();
    ring_radius_ = std::max(ring_radius_, p.cwiseAbs().maxCoeff());
    const std::size_t before = k > 0 ? k - 1 : size_ - 1;
    const auto put = [&p](Points& points, std::size_t lane) {
      points.x[lane] = p[0];
      points.y[lane] = p[1];
      points.z[lane] = p[2];
    };
    put(ring_[k / kLanes], k % kLanes);
    put(ring_next_[before / kLanes], before % kLanes);
  }
  all_.assign(chunks, Masks{});
  for (std::size_t k = 0; k < size_; ++k) all_[k / kLanes][k % kLanes] = -1;
  open_ = all_;
}

void SweepSeparation::set_target(const Vec3& displacement, const Vec3& up) {
  displacement_ = displacement.cast<float>();
  up_ = up.normalized().cast<float>();
  radius_ = std::max(ring_radius_, displacement_.cwiseAbs().maxCoeff());
}

void SweepSeparation::open_all() { std::copy(all_.begin(), all_.end(), open_.begin()); }

bool SweepSeparation::is_any_open() const {
  Masks any{};
  for (const Masks& m : open_) any |= m;
  return (any[0] | any[1] | any[2] | any[3]) != 0;
}

Eigen::Vector3f SweepSeparation::ring_point(std::size_t k) const {
  const Points& p = ring_[k / kLanes];
  return {p.x[k % kLanes], p.y[k % kLanes], p.z[k % kLanes]};
}

bool SweepSeparation::separate(const Corners& candidate) {
  if (!is_any_open()) return true;
  for (int i = 0; i < 3; ++i)
    if (try_axis(up_.cross(candidate[(i + 1) % 3] - candidate[i]), candidate)) return true;
  if (try_axis((candidate[1] - candidate[0]).cross(candidate[2] - candidate[0]), candidate)) return true;
  if (try_axis(up_, candidate)) return true;
  for (std::size_t k = 0; k < size_; ++k)
    if (is_open(k) && try_own_axes(k, candidate)) close(k);
  return !is_any_open();
}

bool SweepSeparation::try_axis(const Eigen::Vector3f& axis, const Corners& candidate) {
  const float t0 = axis.dot(candidate[0]), t1 = axis.dot(candidate[1]), t2 = axis.dot(candidate[2]), shift = axis.dot(displacement_);
  const float candidate_radius =
      std::max({candidate[0].cwiseAbs().maxCoeff(), candidate[1].cwiseAbs().maxCoeff(), candidate[2].cwiseAbs().maxCoeff(), radius_});
  const float margin = kMarginRel * candidate_radius * axis.cwiseAbs().sum() + kMarginAbs;
  const float low = std::min({t0, t1, t2}) - margin, high = std::max({t0, t1, t2}) + margin;
  const float center_low = std::min(shift, 0.0F), center_high = std::max(shift, 0.0F);
  if (center_low <= high && low <= center_high) return false;  // overlaps every sweep
  const Floats ax = Floats{} + axis[0], ay = Floats{} + axis[1], az = Floats{} + axis[2];
  Masks any{};
  for (std::size_t c = 0; c < ring_.size(); ++c) {
    const Floats h = ax * ring_[c].x + ay * ring_[c].y + az * ring_[c].z;
    const Floats g = ax * ring_next_[c].x + ay * ring_next_[c].y + az * ring_next_[c].z;
    const Masks is_clear = center_low > high ? ((h > high) & (g > high)) : ((h < low) & (g < low));
    open_[c] &= ~is_clear;
    any |= open_[c];
  }
  return (any[0] | any[1] | any[2] | any[3]) == 0;
}

bool SweepSeparation::try_own_axes(std::size_t k, const Corners& candidate) {
  const Eigen::Vector3f a = ring_point(k), b = ring_point(k + 1 < size_ ? k + 1 : 0);
  const auto is_apart_along = [&](const Eigen::Vector3f& axis) {
    const float t0 = axis.dot(candidate[0]), t1 = axis.dot(candidate[1]), t2 = axis.dot(candidate[2]);
    const float ha = axis.dot(a), hb = axis.dot(b), shift = axis.dot(displacement_);
    const float candidate_radius =
        std::max({candidate[0].cwiseAbs().maxCoeff(), candidate[1].cwiseAbs().maxCoeff(), candidate[2].cwiseAbs().maxCoeff(), radius_});
    const float margin = kMarginRel * candidate_radius * axis.cwiseAbs().sum() + kMarginAbs;
    return std::min({t0, t1, t2}) > std::max({ha, hb, shift, 0.0F}) + margin || std::max({t0, t1, t2}) + margin < std::min({ha, hb, shift, 0.0F});
  };
  return is_apart_along(up_.cross(b - a)) || is_apart_along((a - displacement_).cross(b - displacement_)) ||
         is_apart_along(up_.cross(a - displacement_)) || is_apart_along(up_.cross(b - displacement_)) || is_apart_along(a.cross(b));
}

}  // namespace smopt
