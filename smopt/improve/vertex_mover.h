#pragma once

#include <memory>

#include "smopt/improve/guarded_surface.h"
#include "smopt/improve/move_guard.h"
#include "smopt/improve/star_move.h"

namespace smopt {

/// What a move must keep to.
struct MoveRules {
  GuardKind guard = GuardKind::exact;
  int vicinity = 2;           ///< rings of triangles that the paper's guard looks at; ≥ 1
  int halvings = 10;          ///< how often a refused step is halved before the vertex stays; ≥ 0
  bool keeps_angles = true;   ///< whether a step is refused that leaves an angle below `min_angle_deg` and smaller than it was
  double min_angle_deg = 10;  ///< [0, 60)
};

/// What became of a visit to a vertex.
enum class Visit { unmoved, moved, moved_shortened, refused, postponed };

/// Moves single vertices as far as a guard lets them; each thread has one.
class VertexMover {
 public:
  VertexMover(const GuardedSurface& surface, const MoveRules& rules, std::unique_ptr<MoveGuard> guard);

  /// Announces the vertices to be visited next, and the part of the surface that is this thread's (see `MoveGuard::enter`).
  void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) { guard_->enter(group, region); }

  /// Moves v by the step, or by the largest of its halves that the guard and `keeps_angles` let pass; postpones when that needs more than the
  /// region.
  Visit visit(VertexId v, const Vec3& step);

  /// Length of the last move, Å.
  [[nodiscard]] double moved_by() const { return moved_by_; }

 private:
  [[nodiscard]] bool makes_bad_angle_worse() const;

  MoveRules rules_;
  StarMove move_;
  std::unique_ptr<MoveGuard> guard_;
  double bad_squared_sine_;  // of the threshold angle
  double moved_by_ = 0;
};

}  // namespace smopt
