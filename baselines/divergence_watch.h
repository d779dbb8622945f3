#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// Sees when an iteration blows up: the first step after which a coordinate is not finite, or a vertex is farther from the centre of the
/// bounding box it began in than ten of its diagonals.
class DivergenceWatch {
 public:
  explicit DivergenceWatch(std::span<const Vec3> start);
  explicit DivergenceWatch(std::span<const Eigen::Vector3f> start);

  /// Looks at the positions after step `step` (from 1); nothing once a bad step has been seen. Cost: O(n).
  void look(std::span<const Vec3> points, int step);
  void look(std::span<const Eigen::Vector3f> points, int step);

  [[nodiscard]] std::optional<int> first_bad_step() const { return first_bad_step_; }

 private:
  /// Where vertices may be.
  struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
  };
  template <class Point>
  static Ball allowed_ball(std::span<const Point> start);
  template <class Point>
  [[nodiscard]] bool any_outside(std::span<const Point> points) const;

  Ball allowed_;
  std::optional<int> first_bad_step_;
};

}  // namespace smopt::baselines
