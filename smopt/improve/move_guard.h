#pragma once

#include <memory>
#include <span>

#include "smopt/geometry/triangle_grid.h"
#include "smopt/improve/guarded_surface.h"
#include "smopt/improve/star_move.h"

namespace smopt {

/// Decides whether a vertex may move, and moves it: is_ok() and apply() are a pair.
class MoveGuard {
 public:
  MoveGuard() = default;
  MoveGuard(const MoveGuard&) = delete;
  MoveGuard& operator=(const MoveGuard&) = delete;
  virtual ~MoveGuard() = default;

  /// Announces the vertices to be selected next, neighbours in space. Must be called whenever the surface was changed by others. Until the next
  /// call, nothing outside `region` is read (null: the whole surface may be).
  virtual void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) = 0;

  /// Takes up a move with its vertex selected; `reach` is the farthest target that will be asked for. The move must outlive the questions.
  virtual void select(const StarMove& move, const Vec3& reach) = 0;

  /// Whether all that decisions about the selected vertex read, and all that moving it changes, lies within the region.
  [[nodiscard]] virtual bool is_within_region() const = 0;

  /// Whether the selected vertex may go to the target that the move is aimed at, a point on the segment from its position to `reach`.
  [[nodiscard]] virtual bool is_ok() = 0;

  /// Whether making the accepted move has to wait until nobody else is at work on the surface.
  [[nodiscard]] virtual bool must_wait() const = 0;

  /// Makes the move that is_ok() accepted last.
  virtual void apply() = 0;
};

/// Who decides.
enum class GuardKind {
  exact,  ///< every triangle near the star, exactly, on the whole way (see `ExactGuard`)
  paper,  ///< the triangles of some rings around the star, at rest, in floating point (see `PaperGuard`)
  none    ///< nobody: plain smoothing
};

/// Makes guards of one kind for a surface; each thread has its own.
class GuardFactory {
 public:
  /// \param vicinity  rings of triangles that the paper's guard looks at; ≥ 1.
  GuardFactory(GuardKind kind, GuardedSurface& surface, int vicinity) : kind_(kind), surface_(surface), vicinity_(vicinity) {}

  [[nodiscard]] std::unique_ptr<MoveGuard> operator()() const;

 private:
  GuardKind kind_;
  GuardedSurface& surface_;
  int vicinity_;
};

}  // namespace smopt
