#pragma once

#include <vector>

#include "smopt/geometry/star_outline.h"
#include "smopt/geometry/triangle_batch.h"
#include "smopt/geometry/triangle_intersection.h"
#include "smopt/improve/remesh/editable_surface.h"
#include "smopt/improve/star_judge.h"
#include "smopt/improve/vertex_bits.h"

namespace smopt {

/// Decides whether a patch may be replaced, against the whole surface and exactly, as `ExactGuard` does for moves: refused when
///  - a triangle outside of the patch meets a new triangle, or a tetrahedron that is swept, elsewhere than in what they share, or
///  - two new triangles meet elsewhere than in what they share, or one is degenerate.
/// Where old and new triangles are seen one-to-one along one axis, what is swept lies in the prism over the outline of the patch, which settles
/// most triangles (`StarOutline`); exact predicates decide about the others, and about all where there is no such axis.
/// Several guards may work on one surface at the same time when each keeps to a region of its own.
/// Cost: some microseconds.
class PatchGuard {
 public:
  explicit PatchGuard(const EditableSurface& surface) : surface_(surface), stars_(surface.guarded()) {}

  /// Until the next call nothing outside of `region` is read (null: the whole surface may be).
  void enter(const TriangleGrid::CubeRange* region) { region_ = region; }
  /// The box of all that is swept.
  [[nodiscard]] Box reach_of(const Patch& patch) const;
  /// Whether all that the decision reads, and all that the replacement changes, lies within the region.
  [[nodiscard]] bool is_within_region(const Patch& patch) const;
  /// Whether the patch may be replaced. \pre is_within_region(patch).
  [[nodiscard]] bool is_ok(const Patch& patch);
  /// Whether replacing has to wait until nobody else is at work on the surface (see `TriangleGrid::needs_whole_grid`).
  [[nodiscard]] bool must_wait(const Patch& patch) const;

 private:
  [[nodiscard]] bool find_axis(const Patch& patch);
  [[nodiscard]] bool is_fold_free(const Patch& patch) const;
  void draw_outline(const Patch& patch);
  [[nodiscard]] bool is_clear_of_surroundings(const Patch& patch);
  [[nodiscard]] bool is_clear_by_outline(const Patch& patch, FaceId f, const Triangle& triangle) const;
  [[nodiscard]] bool is_clear_of(const Patch& patch, const Triangle& triangle) const;
  [[nodiscard]] TrianglePoints points_of(const Triangle& t) const;

  const EditableSurface& surface_;
  StarJudge stars_;
  const TriangleGrid::CubeRange* region_ = nullptr;
  std::vector<FaceId> near_;  // triangles whose boxes overlap what is swept
  VertexBits bits_;
  std::vector<Vec3> spokes_;
  std::vector<Eigen::Vector3f> directions_;  // of the normals, old and new
  Eigen::Vector3f axis_ = Eigen::Vector3f::Zero();
  bool has_outline_ = false;
  StarOutline outline_;
  float outline_radius_ = 0;  // no coordinate, relative to the patch's centre, of what is held against the outline is larger, Å
  unsigned seen_ = 0;         // boundary vertices whose stars are seen one-to-one along the axis, a bit each
  unsigned settled_ = 0;      // boundary vertices whose other triangles need no look
};

}  // namespace smopt
