#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "smopt/geometry/vec3.h"

/// Formulas for one triangle: the only place where the improvement's side of the project has them.
namespace smopt {

/// Twice the area vector, (b − a) × (c − a); along the outward normal for an anticlockwise triangle.
inline Vec3 doubled_area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

/// Six times the signed volume of the tetrahedron that the triangle forms with the origin.
inline double sextuple_volume(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

/// Distance of p to the segment ab where its projection falls strictly inside the segment; infinity where it does not.
inline double distance_to_open_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = (p - a).dot(ab);
  const double length2 = ab.squaredNorm();
  if (!(t > 0 && t < length2)) return HUGE_VAL;
  return (p - a - (t / length2) * ab).norm();
}

/// Square of the sine of the smallest angle, 4A²/(product of the squares of the two longer edges); 0 for a degenerate triangle.
inline double squared_sine_of_smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  const double ab = p.squaredNorm(), ca = q.squaredNorm(), bc = (c - b).squaredNorm();
  const double shortest = std::min({ab, bc, ca});
  const double product = ab * bc * ca;
  return product > 0 ? p.cross(q).squaredNorm() * shortest / product : 0.0;
}

inline constexpr double kDegrees = 180 / std::numbers::pi;  ///< in a radian

/// A triangle's angles (radians) and its shortest/longest edge; 0, π and 0 where two corners are in one place.
struct TriangleShape {
  double smallest_angle = 0;
  double largest_angle = std::numbers::pi;
  double edge_ratio = 0;
};

/// Cost: two arc cosines.
inline TriangleShape shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  double x = (b - a).squaredNorm(), y = (c - b).squaredNorm(), z = (a - c).squaredNorm();
  if (x > y) std::swap(x, y);
  if (y > z) std::swap(y, z);
  if (x > y) std::swap(x, y);
  if (!(x > 0)) return {};
  return {std::acos(std::min(1.0, (y + z - x) / (2 * std::sqrt(y * z)))), std::acos(std::max(-1.0, (x + y - z) / (2 * std::sqrt(x * y)))),
          std::sqrt(x / z)};
}

/// The angle between two neighbouring triangles (π: in one plane), by the cosine between their unit normals; 0 where that is not a number.
inline double dihedral_angle(double cosine_of_normals) {
  return std::isnan(cosine_of_normals) ? 0 : std::acos(std::clamp(-cosine_of_normals, -1.0, 1.0));
}

/// Which triangles count as low quality (Liu et al. 2017, section 0.3: "low edge ratio or containing tiny angles").
struct QualityThresholds {
  double edge_ratio = 0.1;      ///< shortest/longest edge below this; [0, 1)
  double min_angle_deg = 10.0;  ///< an angle below this; [0, 60)
};

/// Tests triangles against thresholds without a square root or an arc cosine.
class QualityTest {
 public:
  explicit QualityTest(const QualityThresholds& thresholds)
      : edge_ratio2_(thresholds.edge_ratio * thresholds.edge_ratio), cos2_(square_of_cos(thresholds.min_angle_deg)) {}

  [[nodiscard]] bool is_low(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    const double longest = std::max({ab, bc, ca});
    if (shortest <= edge_ratio2_ * longest && edge_ratio2_ > 0) return true;
    // The smallest angle faces the shortest edge: cos = (p² + q² − s²) / (2pq), and p² + q² > s².
    const double middle = ab + bc + ca - shortest - longest;
    const double twice_dot = middle + longest - shortest;
    return cos2_ < 1 && twice_dot * twice_dot > 4 * cos2_ * middle * longest;
  }

 private:
  static double square_of_cos(double degrees) { return degrees <= 0 ? 1.0 : std::pow(std::cos(degrees * std::numbers::pi / 180), 2); }

  double edge_ratio2_;
  double cos2_;
};

}  // namespace smopt
