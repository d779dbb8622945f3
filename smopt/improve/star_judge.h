#pragma once

#include <vector>

#include "smopt/geometry/normal_cone.h"
#include "smopt/improve/guarded_surface.h"
#include "smopt/improve/star_move.h"

namespace smopt {

/// Decides whether a star stays free of folds while its vertex moves, and keeps the normal cones of the vertices concerned.
class StarJudge {
 public:
  explicit StarJudge(const GuardedSurface& surface) : surface_(surface) {}

  /// Whether no two triangles of the star meet, at the target or on the way, elsewhere than in what they share, and none is degenerate at the
  /// target. By a cone where there is one, else exactly.
  [[nodiscard]] bool is_free_of_folds(const StarMove& move);

  // For the move that was accepted last:

  /// Whether the star is seen one-to-one along the axis that the vertex had already, before and after, with room for rounding.
  [[nodiscard]] bool is_projected() const { return is_projected_; }
  /// After the move: the vertex's cone, and the ring vertices'. A ring vertex's cone that is known holds its star before the move too.
  [[nodiscard]] const NormalCone& cone() const { return cone_; }
  [[nodiscard]] const std::vector<NormalCone>& ring_cones() const { return ring_cones_; }

  /// Whether the star of ring vertex w, as it is before the move, is seen one-to-one along the axis.
  [[nodiscard]] bool is_ring_vertex_seen_along(VertexId w, const Eigen::Vector3f& axis) const;

 private:
  [[nodiscard]] bool has_cone();
  [[nodiscard]] bool is_fold_free_at_target() const;
  [[nodiscard]] bool is_fold_free_on_the_way() const;
  [[nodiscard]] NormalCone find_own_cone();
  [[nodiscard]] NormalCone find_ring_cone(std::size_t slot);
  void update_ring_cones();

  const GuardedSurface& surface_;
  const StarMove* move_ = nullptr;
  std::vector<Eigen::Vector3f> directions_;  // of the normals at the target, as `reliable_direction`
  bool is_projected_ = false;
  NormalCone cone_;
  std::vector<NormalCone> ring_cones_;
  MovingStar scratch_star_;
};

}  // namespace smopt
