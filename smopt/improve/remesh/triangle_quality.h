#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "smopt/geometry/vec3.h"
#include "smopt/improve/remesh/remesh_goals.h"

namespace smopt {

/// How near triangles and edges are to the goals: 1 where they just reach all, above where they do better, 0 at the worst.
class TriangleQuality {
 public:
  explicit TriangleQuality(const RemeshGoals& goals)
      : per_min_angle_(kDegrees / goals.min_angle_deg),
        per_max_angle_(kDegrees / (180 - goals.max_angle_deg)),
        per_squared_ratio_(1 / std::max(goals.edge_ratio * goals.edge_ratio, kSmallest)),
        per_dihedral_(kDegrees / std::max(goals.min_dihedral_deg, kSmallest)) {}

  /// Of a triangle: the smallest of (smallest angle)/(its goal), (180° − largest angle)/(180° − its goal) and (edge ratio)²/(its goal)².
  /// Cost: two arc cosines.
  [[nodiscard]] double of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) const {
    double x = (b - a).squaredNorm(), y = (c - b).squaredNorm(), z = (a - c).squaredNorm();
    if (x > y) std::swap(x, y);
    if (y > z) std::swap(y, z);
    if (x > y) std::swap(x, y);
    if (!(x > 0)) return 0;
    const double smallest = std::acos(std::min(1.0, (y + z - x) / (2 * std::sqrt(y * z))));
    const double beyond_largest = std::acos(std::min(1.0, (z - x - y) / (2 * std::sqrt(x * y))));
    return std::min({smallest * per_min_angle_, beyond_largest * per_max_angle_, x / z * per_squared_ratio_});
  }

  /// Of an edge: (dihedral angle)/(its goal), by the cosine between the normals of its triangles.
  [[nodiscard]] double of_bend(double cosine) const { return std::acos(std::clamp(-cosine, -1.0, 1.0)) * per_dihedral_; }

 private:
  static constexpr double kDegrees = 180 / std::numbers::pi;
  static constexpr double kSmallest = 1e-300;  // a goal of 0 is always reached

  double per_min_angle_, per_max_angle_, per_squared_ratio_, per_dihedral_;
};

}  // namespace smopt
