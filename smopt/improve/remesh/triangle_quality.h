#pragma once

#include <algorithm>
#include <numbers>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/geometry/vec3.h"
#include "smopt/improve/remesh/remesh_goals.h"

namespace smopt {

/// How near triangles and edges are to the goals: 1 where they just reach all, above where they do better, 0 at the worst.
class TriangleQuality {
 public:
  explicit TriangleQuality(const RemeshGoals& goals)
      : per_min_angle_(kDegrees / goals.min_angle_deg),
        per_max_angle_(kDegrees / (180 - goals.max_angle_deg)),
        per_ratio_(1 / std::max(goals.edge_ratio, kSmallest)),
        per_dihedral_(kDegrees / std::max(goals.min_dihedral_deg, kSmallest)) {}

  /// Of a triangle: the smallest of (smallest angle)/(its goal), (180° − largest angle)/(180° − its goal) and (edge ratio)/(its goal).
  /// Cost: two arc cosines.
  [[nodiscard]] double of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const TriangleShape shape = shape_of(a, b, c);
    return std::min(
        {shape.smallest_angle * per_min_angle_, (std::numbers::pi - shape.largest_angle) * per_max_angle_, shape.edge_ratio * per_ratio_});
  }

  /// Of an edge: (dihedral angle)/(its goal), by the cosine between the normals of its triangles.
  [[nodiscard]] double of_bend(double cosine) const { return dihedral_angle(cosine) * per_dihedral_; }

 private:
  static constexpr double kSmallest = 1e-300;  // a goal of 0 is always reached

  double per_min_angle_, per_max_angle_, per_ratio_, per_dihedral_;
};

}  // namespace smopt
