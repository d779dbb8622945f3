#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// A direction along which a star of triangles is seen one-to-one, and how far the triangles' normals are from it.
///
/// Single precision: any direction will do, it need not be accurate, only always the same.
struct NormalCone {
  /// Stands for "no bound".
  static constexpr float kNoBound = 2;

  std::array<float, 3> axis{};    ///< length 1; zero where no such direction is known
  float squared_sine = kNoBound;  ///< of an angle that no normal has to the axis or more; kNoBound where none is known
};

inline bool is_known(const NormalCone& cone) {
  return cone.axis[0] != 0 || cone.axis[1] != 0 || cone.axis[2] != 0;
}
inline Vec3 axis_of(const NormalCone& cone) {
  return {cone.axis[0], cone.axis[1], cone.axis[2]};
}
/// The same in single precision.
inline Eigen::Vector3f single_axis_of(const NormalCone& cone) {
  return {cone.axis[0], cone.axis[1], cone.axis[2]};
}

/// A component n · axis of a doubled area vector of edges no longer than L, |axis| ≤ 1, carries a rounding error below 5√3·2⁻⁵³ L²; forty
/// times that is safe and still far below the area of any triangle that can be told from a degenerate one.
inline constexpr double kConeMarginRel = 4e-14;

/// A doubled area vector shorter than this part of L² has no direction to rely on: the rounding error above may turn it by 1e-6 rad.
inline constexpr double kDirectionMarginRel = 1e-9;

/// What cosines and squared sines of cones may be off by: single precision and the turn above, tenfold.
inline constexpr float kConeRounding = 1e-5F;

/// The unit vector of a doubled area vector, or zero where it has no direction to rely on. `longest2` is the square of the longest edge.
inline Eigen::Vector3f reliable_direction(const Vec3& doubled_area, double longest2) {
  const double norm = doubled_area.norm();
  return norm > kDirectionMarginRel * longest2 ? Eigen::Vector3f((doubled_area / norm).cast<float>()) : Eigen::Vector3f(0, 0, 0);
}

/// The same for a triangle by its corners.
inline Eigen::Vector3f reliable_direction(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  return reliable_direction(p.cross(q), std::max({p.squaredNorm(), q.squaredNorm(), (q - p).squaredNorm()}));
}

/// Widens the bound to hold for a triangle's normal too (as `reliable_direction` gives it).
inline void widen(NormalCone& cone, const Eigen::Vector3f& normal) {
  const float cosine = normal[0] * cone.axis[0] + normal[1] * cone.axis[1] + normal[2] * cone.axis[2];
  const float squared_sine = cosine > 10 * kConeRounding ? 1 - cosine * cosine + kConeRounding : NormalCone::kNoBound;
  cone.squared_sine = std::max(cone.squared_sine, squared_sine);
}

/// Whether every triangle of the star has a positive component along another axis of length 1 as well. The star is then seen one-to-one along
/// that too: on the way from axis to axis no triangle is ever seen edge-on, so the star keeps turning around its centre once.
inline bool is_seen_along(const NormalCone& cone, const Eigen::Vector3f& axis) {
  const float cosine = axis[0] * cone.axis[0] + axis[1] * cone.axis[1] + axis[2] * cone.axis[2];
  return cosine > 0 && cosine * cosine > cone.squared_sine + kConeRounding;
}

/// The cone around the mean of the normals of a star (as `reliable_direction` gives them) that is known to be seen one-to-one along some axis
/// on which all normals are positive; unknown where the mean is not such an axis. Cost: O(valence).
NormalCone cone_around(std::span<const Eigen::Vector3f> normals);

/// The cone of a star at rest. Cost: O(valence).
NormalCone find_resting_cone(const Vec3& center, const std::vector<Vec3>& ring, std::span<const Eigen::Vector3f> normals);

/// A star at the start and at the end of the move of one of its points (its centre or one on its ring).
struct MovingStar {
  Vec3 center_from, center_to;
  std::vector<Vec3> ring_from, ring_to;  ///< in order, anticlockwise seen from outside
};

/// Finds an axis along which the star projects one-to-one from the start of the move (where a triangle may be exactly degenerate) to its
/// end; the bound is for the end.
///
/// Every triangle has a component along the axis above the rounding margin at both ends; it is linear in the moving point and so positive
/// all the way. The star then turns around its centre a whole number of times in one direction; that number is one at the end, so it is one
/// all the way, and the projection is one-to-one: triangles of the star meet nowhere but in what they share. Unknown when the mean normal is
/// not such an axis. Cost: O(valence).
NormalCone find_cone(const MovingStar& star);

}  // namespace smopt
