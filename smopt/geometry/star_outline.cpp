#include "smopt/geometry/star_outline.h"

#include <algorithm>
#include <cmath>

namespace smopt {
namespace {

/// A single-precision projection on a direction of length up to 2 of a point with coordinates up to R is off by less than 12·2⁻²⁴·R (the
/// point's rounding, three products, three sums); both sides together, doubled.
constexpr float kMarginRel = 3e-6F;
/// Four of these are multiplied in a cross product of two edges no longer than 2√3 R, each off by 2·1.2e-6 R; doubled.
constexpr float kCrossMarginRel = 4e-5F;
/// A cross product of differences of coordinates no larger than L, each off by the margin m, is off by less than 12·m·L.
constexpr float kPartingMargin = 12;
/// Keeps the margins above what products may lose by underflow.
constexpr float kMarginAbs = 64 * std::numeric_limits<float>::min();

float smallest_lane(Floats v) {
  return std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
}
float largest_lane(Floats v) {
  return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
}

}  // namespace

void StarOutline::set(std::span<const Vec3> ring, const Vec3& displacement, const Eigen::Vector3f& up, const Vec3& place, float radius) {
  valence_ = ring.size();
  all_ = (1U << valence_) - 1;
  center_ = 3U << valence_;
  int smallest = 0;
  up.cwiseAbs().minCoeff(&smallest);
  frame_[0] = up.cross(Eigen::Vector3f::Unit(smallest)).normalized();
  frame_[1] = up.cross(frame_[0]);
  frame_[2] = up;
  for (std::size_t i = 0; i < 9; ++i) rows_[i] = in_all_lanes(frame_[i / 3][static_cast<int>(i % 3)]);
  const Eigen::Vector3f at = place.cast<float>();
  double largest = displacement.cwiseAbs().maxCoeff();
  for (const Vec3& p : ring) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  radius_ = static_cast<float>(largest);
  margin_ = kMarginRel * (std::max(radius, at.cwiseAbs().maxCoeff()) + radius_) + kMarginAbs;
  place_x_ = frame_[0].dot(at);
  place_y_ = frame_[1].dot(at);
  project(ring, displacement);
  extents_ = {extent({1, 0, 0}, place_x_), extent({0, 1, 0}, place_y_), extent({1, 1, 0}, place_x_ + place_y_),
              extent({1, -1, 0}, place_x_ - place_y_), extent({0, 0, 1}, frame_[2].dot(at))};
  find_convex_corners();
}

void StarOutline::project(std::span<const Vec3> ring, const Vec3& displacement) {
  std::array<Floats, kChunks> px{}, py{}, pz{};  // the vertex itself, at 0, fills up
  const auto put = [&](std::size_t i, const Vec3& p) {
    px[i / kLanes][i % kLanes] = static_cast<float>(p[0]);
    py[i / kLanes][i % kLanes] = static_cast<float>(p[1]);
    pz[i / kLanes][i % kLanes] = static_cast<float>(p[2]);
  };
  for (std::size_t i = 0; i < ring.size(); ++i) put(i, ring[i]);
  put(ring.size(), displacement);
  points_.chunks = (ring.size() + 2 + kLanes - 1) / kLanes;
  for (std::size_t c = 0; c < points_.chunks; ++c) {
    points_.x[c] = rows_[0] * px[c] + rows_[1] * py[c] + rows_[2] * pz[c];
    points_.y[c] = rows_[3] * px[c] + rows_[4] * py[c] + rows_[5] * pz[c];
    points_.z[c] = rows_[6] * px[c] + rows_[7] * py[c] + rows_[8] * pz[c];
  }
}

StarOutline::Extent StarOutline::extent(const std::array<float, 3>& direction, float place) const {
  const auto along = [&](std::size_t c) { return direction[0] * points_.x[c] + direction[1] * points_.y[c] + direction[2] * points_.z[c]; };
  Floats low = along(0), high = low;
  for (std::size_t c = 1; c < points_.chunks; ++c) {
    const Floats h = along(c);
    low = smaller_of(low, h);
    high = larger_of(high, h);
  }
  return {in_all_lanes(smallest_lane(low) + place - margin_), in_all_lanes(largest_lane(high) + place + margin_)};
}

unsigned StarOutline::not_left_of(float x, float y, float dx, float dy, float margin) const {
  const Floats offset = in_all_lanes(dx * y - dy * x + margin);
  unsigned left = 0;  // not a number is not to the left
  for (std::size_t c = 0; c < points_.chunks; ++c) left |= lanes_set(dx * points_.y[c] - dy * points_.x[c] > offset) << (kLanes * c);
  return ~left & ((4U << valence_) - 1);
}

void StarOutline::find_convex_corners() {
  const float margin = kCrossMarginRel * radius_ * radius_ + kMarginAbs;
  const auto x = [&](std::size_t k) { return points_.x[k / kLanes][k % kLanes]; };
  const auto y = [&](std::size_t k) { return points_.y[k / kLanes][k % kLanes]; };
  unsigned supporting = 0;  // a bit per edge: all else lies strictly to its left
  for (std::size_t k = 0; k < valence_; ++k) {
    const std::size_t next = k + 1 < valence_ ? k + 1 : 0;
    const float dx = x(next) - x(k), dy = y(next) - y(k);
    edge_x_[k / kLanes][k % kLanes] = dx;
    edge_y_[k / kLanes][k % kLanes] = dy;
    edge_offset_[k / kLanes][k % kLanes] = dx * y(k) - dy * x(k);
    const unsigned beyond = not_left_of(x(k), y(k), dx, dy, margin) & ~(1U << k | 1U << next);
    supporting |= (beyond == 0 ? 1U : 0U) << k;
  }
  convex_ = supporting & (supporting << 1 | supporting >> (valence_ - 1));
}

bool StarOutline::is_clear_of(const TriangleBatch::Entry& t) const {
  const Floats x = rows_[0] * t.x + rows_[1] * t.y + rows_[2] * t.z;
  if (extents_[0].is_beyond(x)) return true;
  const Floats y = rows_[3] * t.x + rows_[4] * t.y + rows_[5] * t.z;
  if (extents_[1].is_beyond(y) || extents_[2].is_beyond(x + y) || extents_[3].is_beyond(x - y)) return true;
  return extents_[4].is_beyond(rows_[6] * t.x + rows_[7] * t.y + rows_[8] * t.z);
}

unsigned StarOutline::edges_left_of(Floats x, Floats y, float margin) const {
  unsigned edges = 0;
  for (std::size_t c = 0; c * kLanes < valence_; ++c) {
    const Floats limit = edge_offset_[c] - margin;
    Masks is_right = edge_x_[c] * y[0] - edge_y_[c] * x[0] < limit;
    is_right &= edge_x_[c] * y[1] - edge_y_[c] * x[1] < limit;
    is_right &= edge_x_[c] * y[2] - edge_y_[c] * x[2] < limit;
    edges |= lanes_set(is_right) << (kLanes * c);
  }
  return edges;
}

bool StarOutline::is_parted_from_others(const TriangleBatch::Entry& t, unsigned own) const {
  const Floats x = rows_[0] * t.x + rows_[1] * t.y + rows_[2] * t.z - place_x_;
  const Floats y = rows_[3] * t.x + rows_[4] * t.y + rows_[5] * t.z - place_y_;
  const float largest = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2]), std::abs(y[0]), std::abs(y[1]), std::abs(y[2])});
  const float margin = kPartingMargin * margin_ * (largest + 2 * radius_) + kMarginAbs;
  if (!((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]) > margin)) return false;
  unsigned open = all_ & ~triangles_with(own);
  for (std::size_t i = 0; i < 3 && open != 0; ++i) {
    const std::size_t j = i < 2 ? i + 1 : 0;
    // An anticlockwise triangle lies to the left of its sides, so what is to the left of the side turned round is beyond it.
    const unsigned not_beyond = not_left_of(x[i], y[i], x[i] - x[j], y[i] - y[j], margin);
    const bool is_center_beyond = (not_beyond & center_) == 0;
    if (is_center_beyond) open &= triangles_with(not_beyond & all_);
  }
  if (open != 0) open &= ~edges_left_of(x, y, margin);
  if (open != 0) open &= ~triangles_beyond_spokes(x, y, margin);
  return open == 0;
}

unsigned StarOutline::triangles_beyond_spokes(Floats x, Floats y, float margin) const {
  const float to_x = points_.x[(valence_) / kLanes][valence_ % kLanes], to_y = points_.y[valence_ / kLanes][valence_ % kLanes];
  unsigned right = 0, left = 0;  // spokes that have all three points to their right, or left, and beyond the target
  for (std::size_t c = 0; c * kLanes < valence_; ++c) {
    const auto cross = [&](float px, float py) { return points_.x[c] * py - points_.y[c] * px; };
    const Floats a = cross(x[0], y[0]), b = cross(x[1], y[1]), d = cross(x[2], y[2]), target = cross(to_x, to_y), none{};
    right |= lanes_set(larger_of(larger_of(a, b), d) < smaller_of(target, none) - margin) << (kLanes * c);
    left |= lanes_set(smaller_of(smaller_of(a, b), d) > larger_of(target, none) + margin) << (kLanes * c);
  }
  // Triangle k is between spokes k and k + 1.
  left &= all_;
  return right | left >> 1 | left << (valence_ - 1);
}

}  // namespace smopt
