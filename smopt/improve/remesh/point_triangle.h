#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "smopt/geometry/vec3.h"

/// Distance of a point to one triangle that may be a needle, a segment or a point: the answers are points of the triangle whatever its shape,
/// so that a distance is never understated, and a certificate says how much it may be overstated.
namespace smopt {

/// The corners of a triangle, Å.
using Corners = std::array<Vec3, 3>;

/// Relative height (height / longest edge) up to which a triangle counts as a segment here: its normal then has an error of about 1e-16 / 1e-8,
/// and a nearest point that is looked for on the edges alone is off by no more than the height. The two errors balance at 1e-8.
inline constexpr double kFlatHeightRel = 1e-8;

/// The point of the segment ab nearest to p; a where it has no length.
inline Vec3 nearest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return a + t * ab;
}

/// The point of a triangle nearest to p: exactly in the triangle but for the last rounding, nearest up to 1e-8 of its size.
///
/// By regions (Ericson, Real-Time Collision Detection, 2005, section 5.1.5), told by barycentric weights from cross products, which stay sharp
/// on needles; outside, only the edges that have the point on their outer side can be nearest.
/// \param p  finite, as are the corners; otherwise the result is not
inline Vec3 nearest_point_of_triangle(const Vec3& p, const Corners& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const Vec3 normal = ab.cross(ac);
  const double whole = normal.squaredNorm();
  const double longest2 = std::max(ab.squaredNorm(), ac.squaredNorm());
  const bool is_flat = !(whole > kFlatHeightRel * kFlatHeightRel * longest2 * longest2);
  const double v = normal.dot(ap.cross(ac)), w = normal.dot(ab.cross(ap)), u = whole - v - w;
  if (!is_flat && u > 0 && v > 0 && w > 0) return t[0] + (v / whole) * ab + (w / whole) * ac;
  const std::array<double, 3> weight_facing = {w, u, v};  // of the edges ab, bc, ca
  Vec3 best = t[0];
  double best2 = ap.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_flat && weight_facing[i] > 0) continue;
    const Vec3 q = nearest_point_of_segment(p, t[i], t[(i + 1) % 3]);
    const double q2 = (p - q).squaredNorm();
    if (q2 < best2) {
      best = q;
      best2 = q2;
    }
  }
  return best;
}

/// A distance that no point of the triangle is nearer to p than, but for rounding: that of the plane through the nearest corner, square to
/// p − q. For the nearest point q it is the distance itself; for any other point q it is less.
inline double distance_at_least(const Vec3& p, const Corners& t, const Vec3& q) {
  const Vec3 direction = p - q;
  const double length = direction.norm();
  if (!(length > 0)) return 0;
  return std::max(0.0, std::min({direction.dot(p - t[0]), direction.dot(p - t[1]), direction.dot(p - t[2])}) / length);
}

}  // namespace smopt
