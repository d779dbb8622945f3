#include "smopt/improve/star_move.h"

#include <algorithm>

#include "smopt/geometry/triangle_shape.h"

namespace smopt {

void StarMove::select(VertexId v) {
  vertex_ = v;
  position_ = mesh_.points[v];
  ring_ = rings_.vertices(v);
  const std::size_t n = ring_.size();
  ring_points_.resize(n);
  spokes_.resize(n);
  longest2_ = 0;
  for (std::size_t k = 0; k < n; ++k) {
    ring_points_[k] = mesh_.points[ring_[k]];
    spokes_[k] = ring_points_[k] - position_;
    longest2_ = std::max(longest2_, spokes_[k].squaredNorm());
  }
}

void StarMove::aim(const Vec3& target) {
  const std::size_t n = ring_.size();
  target_ = target;
  displacement_ = target - position_;
  target_normals_.resize(n);
  target_lengths2_.resize(n);
  target_longest2_ = 0;
  // Not from `spokes_`: where the vertex comes from far away, their rounding would be above the margins.
  Vec3 spoke = ring_points_[0] - target;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 next_spoke = ring_points_[next(k)] - target;
    target_normals_[k] = spoke.cross(next_spoke);
    target_lengths2_[k] = spoke.squaredNorm();
    target_longest2_ = std::max(target_longest2_, target_lengths2_[k]);
    spoke = next_spoke;
  }
}

bool StarMove::has_smaller_angle_at_target(double squared_sine) const {
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const double a = target_lengths2_[k], b = target_lengths2_[next(k)], c = (ring_points_[next(k)] - ring_points_[k]).squaredNorm();
    if (target_normals_[k].squaredNorm() * std::min({a, b, c}) < squared_sine * (a * b * c)) return true;
  }
  return false;
}

double StarMove::squared_sine_at(const Vec3& point) const {
  double smallest = 1;
  for (std::size_t k = 0; k < ring_.size(); ++k)
    smallest = std::min(smallest, squared_sine_of_smallest_angle(point, ring_points_[k], ring_points_[next(k)]));
  return smallest;
}

}  // namespace smopt
