#include "smopt/geometry/sweep_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smopt {
namespace {

/// Projections in single precision of points no farther than R on an axis: rounding of the coordinates, the products and the sums stays
/// below 6·2⁻²⁴ R |axis|₁ for each side, 7.2e-7 together; rounded up.
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
  const Eigen::Vector3f low = displacement_.cwiseMin(0.0F), high = displacement_.cwiseMax(0.0F);
  const auto smaller = [](Floats a, Floats b, float c) {
    const Floats m = a < b ? a : b;
    return m < c ? m : Floats{} + c;
  };
  const auto larger = [](Floats a, Floats b, float c) {
    const Floats m = a > b ? a : b;
    return m > c ? m : Floats{} + c;
  };
  box_low_.resize(ring_.size());
  box_high_.resize(ring_.size());
  for (std::size_t c = 0; c < ring_.size(); ++c) {
    const Points &p = ring_[c], &q = ring_next_[c];
    box_low_[c] = {smaller(p.x, q.x, low[0]), smaller(p.y, q.y, low[1]), smaller(p.z, q.z, low[2])};
    box_high_[c] = {larger(p.x, q.x, high[0]), larger(p.y, q.y, high[1]), larger(p.z, q.z, high[2])};
  }
}

void SweepSeparation::open_all() {
  std::copy(all_.begin(), all_.end(), open_.begin());
}

bool SweepSeparation::is_any_open() const {
  Masks any{};
  for (const Masks& m : open_) any |= m;
  return (any[0] | any[1] | any[2] | any[3]) != 0;
}

Eigen::Vector3f SweepSeparation::ring_point(std::size_t k) const {
  const Points& p = ring_[k / kLanes];
  return {p.x[k % kLanes], p.y[k % kLanes], p.z[k % kLanes]};
}

bool SweepSeparation::separate(const Corners& corners) {
  Measured candidate{corners, corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]), corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
  const float radius = std::max({radius_, -candidate.low.minCoeff(), candidate.high.maxCoeff()});
  candidate.margin_rel = kMarginRel * radius;
  compare_boxes(candidate);
  for (int i = 0; i < 3; ++i) {
    if (!is_any_open()) return true;
    try_axis(up_.cross(corners[(i + 1) % 3] - corners[i]), candidate);
  }
  if (!is_any_open()) return true;
  try_axis((corners[1] - corners[0]).cross(corners[2] - corners[0]), candidate);
  try_axis(up_, candidate);
  for (std::size_t k = 0; k < size_; ++k)
    if (is_open(k) && try_own_axes(k, candidate)) close(k);
  return !is_any_open();
}

void SweepSeparation::compare_boxes(const Measured& candidate) {
  const float margin = candidate.margin_rel + kMarginAbs;
  const Floats lx = Floats{} + (candidate.low[0] - margin), ly = Floats{} + (candidate.low[1] - margin),
               lz = Floats{} + (candidate.low[2] - margin);
  const Floats hx = Floats{} + (candidate.high[0] + margin), hy = Floats{} + (candidate.high[1] + margin),
               hz = Floats{} + (candidate.high[2] + margin);
  for (std::size_t c = 0; c < ring_.size(); ++c) {
    const Points &low = box_low_[c], &high = box_high_[c];
    open_[c] &= (low.x <= hx) & (low.y <= hy) & (low.z <= hz) & (high.x >= lx) & (high.y >= ly) & (high.z >= lz);
  }
}

void SweepSeparation::try_axis(const Eigen::Vector3f& axis, const Measured& candidate) {
  const float t0 = axis.dot(candidate.corners[0]), t1 = axis.dot(candidate.corners[1]), t2 = axis.dot(candidate.corners[2]);
  const float shift = axis.dot(displacement_);
  const float margin = candidate.margin_rel * axis.cwiseAbs().sum() + kMarginAbs;
  const float low = std::min({t0, t1, t2}) - margin, high = std::max({t0, t1, t2}) + margin;
  const bool is_above = std::min(shift, 0.0F) > high, is_below = std::max(shift, 0.0F) < low;
  if (!is_above && !is_below) return;  // overlaps every sweep
  const Floats ax = Floats{} + axis[0], ay = Floats{} + axis[1], az = Floats{} + axis[2];
  for (std::size_t c = 0; c < ring_.size(); ++c) {
    const Floats h = ax * ring_[c].x + ay * ring_[c].y + az * ring_[c].z;
    const Floats g = ax * ring_next_[c].x + ay * ring_next_[c].y + az * ring_next_[c].z;
    open_[c] &= is_above ? ((h <= high) | (g <= high)) : ((h >= low) | (g >= low));
  }
}

bool SweepSeparation::try_own_axes(std::size_t k, const Measured& candidate) {
  const Eigen::Vector3f a = ring_point(k), b = ring_point(k + 1 < size_ ? k + 1 : 0);
  const auto is_apart_along = [&](const Eigen::Vector3f& axis) {
    const float t0 = axis.dot(candidate.corners[0]), t1 = axis.dot(candidate.corners[1]), t2 = axis.dot(candidate.corners[2]);
    const float ha = axis.dot(a), hb = axis.dot(b), shift = axis.dot(displacement_);
    const float margin = candidate.margin_rel * axis.cwiseAbs().sum() + kMarginAbs;
    return std::min({t0, t1, t2}) > std::max({ha, hb, shift, 0.0F}) + margin ||
           std::max({t0, t1, t2}) + margin < std::min({ha, hb, shift, 0.0F});
  };
  return is_apart_along(up_.cross(b - a)) || is_apart_along((a - displacement_).cross(b - displacement_)) ||
         is_apart_along(up_.cross(a - displacement_)) || is_apart_along(up_.cross(b - displacement_)) || is_apart_along(a.cross(b));
}

}  // namespace smopt
