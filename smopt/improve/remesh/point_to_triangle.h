#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// The corners of a triangle, Å.
using Corners = std::array<Vec3, 3>;

/// A triangle prepared for distances from points; it may be a needle, a segment or a point.
///
/// The nearest point is found by regions (Ericson, Real-Time Collision Detection, 2005, section 5.1.5), told by barycentric weights; outside,
/// only the edges that have the point on their outer side can be nearest. Whatever the shape, what is found is a point of the triangle but for
/// the last rounding, so that no distance is understated; overstated it is by at most 1e-8 of the size, on needles.
class PointToTriangle {
 public:
  /// \pre the corners are finite.
  explicit PointToTriangle(const Corners& t) : a_(t[0]), ab_(t[1] - t[0]), ac_(t[2] - t[0]) {
    const Vec3 normal = ab_.cross(ac_);
    const double ab2 = ab_.squaredNorm(), ac2 = ac_.squaredNorm(), whole = normal.squaredNorm();
    per_ab2_ = inverse(ab2);
    per_ac2_ = inverse(ac2);
    per_bc2_ = inverse((ac_ - ab_).squaredNorm());
    const double longest2 = std::max(ab2, ac2);
    if (!(whole > kFlatHeightRel * kFlatHeightRel * longest2 * longest2)) return;
    const double per_whole = 1 / whole;
    sum_of_weights_ = 1;
    weight_b_ = per_whole * ac_.cross(normal);
    weight_c_ = per_whole * normal.cross(ab_);
  }

  /// From the nearest point of the triangle to p; not finite where a coordinate of p is not.
  [[nodiscard]] Vec3 offset(const Vec3& p) const {
    const Vec3 ap = p - a_;
    const double v = weight_b_.dot(ap), w = weight_c_.dot(ap), u = sum_of_weights_ - v - w;
    if (u > 0 && v > 0 && w > 0) return ap - v * ab_ - w * ac_;
    Vec3 best = Vec3::Constant(std::numeric_limits<double>::infinity());
    double best2 = std::numeric_limits<double>::infinity();
    const auto try_edge = [&](const Vec3& from, const Vec3& edge, double per_length2) {
      const Vec3 offset = from - std::min(std::max(from.dot(edge) * per_length2, 0.0), 1.0) * edge;
      const double offset2 = offset.squaredNorm();
      if (!(offset2 < best2)) return;
      best = offset;
      best2 = offset2;
    };
    if (w <= 0) try_edge(ap, ab_, per_ab2_);
    if (v <= 0) try_edge(ap, ac_, per_ac2_);
    if (u <= 0) try_edge(ap - ab_, ac_ - ab_, per_bc2_);
    return best;
  }
  /// Of p, Å².
  [[nodiscard]] double squared_distance(const Vec3& p) const { return offset(p).squaredNorm(); }

  /// A distance that no point of the triangle is nearer to p than, but for rounding: that of the plane square to the offset, through the
  /// corner nearest along it. It is the distance itself, or less where the offset is not quite from the nearest point.
  [[nodiscard]] double distance_below(const Vec3& p) const {
    const Vec3 away = offset(p), ap = p - a_;
    const double length = away.norm();
    if (!(length > 0)) return 0;
    return std::max(0.0, std::min({away.dot(ap), away.dot(ap - ab_), away.dot(ap - ac_)}) / length);
  }

 private:
  /// Relative height (height / longest edge) up to which a triangle counts as a segment here: its normal then has an error of about
  /// 1e-16 / 1e-8, and a nearest point that is looked for on the edges alone is off by no more than the height. The two balance at 1e-8.
  static constexpr double kFlatHeightRel = 1e-8;

  static double inverse(double x) { return x > 0 ? 1 / x : 0; }

  Vec3 a_, ab_, ac_;
  Vec3 weight_b_ = Vec3::Zero(), weight_c_ = Vec3::Zero();  // dot p − a: the barycentric weights of b and c
  double sum_of_weights_ = 0;                               // 1; 0 for a flat triangle, so that all edges are looked at
  double per_ab2_, per_ac2_, per_bc2_;
};

}  // namespace smopt
