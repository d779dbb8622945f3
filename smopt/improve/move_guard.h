#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "smopt/geometry/normal_cone.h"
#include "smopt/geometry/sweep_separation.h"
#include "smopt/improve/guarded_surface.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Decides whether a vertex may move, against the whole surface and exactly; the guarantee of the project rests on this class.
///
/// A move of v from x to x' sweeps, for each triangle (v, a, b) of its star, the tetrahedron (a, b, x, x'). It is refused when
///  - a triangle outside the star meets one of these tetrahedra elsewhere than in a shared vertex or edge (so it neither ends in an
///    intersection nor passes through another sheet nor swallows a component), or
///  - the star folds onto itself at the end or on the way, or
///  - a triangle of the star would be degenerate (exactly collinear).
/// The decision takes three steps, each for what the one before left open:
///  1. normal cones: a vertex keeps an axis on which all triangles of its star have a positive component and around which the star turns
///  once.
///     The star then projects one-to-one along the axis, and as the component is linear in the moving point, it does so all the way if it
///     does at both ends: triangles that share the vertex cannot meet elsewhere. This settles nearly all pairs that share a vertex;
///  2. separating planes in floating point with a rounding margin, for the triangles that the grid finds near the star;
///  3. exact predicates.
/// Several guards may work on one surface at the same time when each keeps to a region of its own (see `is_within`).
/// Cost: about a microsecond a move.
class MoveGuard {
 public:
  explicit MoveGuard(GuardedSurface& surface) : surface_(surface) {}

  /// Makes v the vertex in question; `reach` is the farthest target that will be asked for.
  void select(VertexId v, const Vec3& reach);

  /// Whether all that decisions about the selected vertex read, and all that moving it changes, lies within these cubes of the grid.
  [[nodiscard]] bool is_within(const TriangleGrid::CubeRange& region) const;

  /// Whether the selected vertex may go to `target`, a point on the segment from its position to `reach`.
  [[nodiscard]] bool is_move_ok(const Vec3& target);

  /// Whether applying the accepted move needs the grid for itself (see `TriangleGrid::needs_new_block`).
  [[nodiscard]] bool needs_new_block() const;

  /// Moves the selected vertex to the target that `is_move_ok` accepted last.
  void apply();

 private:
  /// A triangle near the star: its corners relative to the selected vertex, and which of them are where on the ring (kNotOnRing: not at
  /// all).
  struct Candidate {
    FaceId face;
    std::array<int, 3> slots;
    SweepSeparation::Corners points;
  };
  static constexpr int kNotOnRing = -1;

  [[nodiscard]] int slot_of(VertexId w) const;
  [[nodiscard]] Box new_box(std::size_t slot) const;
  void gather_candidates();
  void prepare_target(const Vec3& target);
  [[nodiscard]] Vec3 mean_normal() const;
  [[nodiscard]] bool is_star_ok();
  [[nodiscard]] bool is_fold_free_at_target() const;
  [[nodiscard]] bool is_fold_free_on_the_way() const;
  [[nodiscard]] ConeAxis find_own_axis();
  [[nodiscard]] ConeAxis find_ring_axis(std::size_t slot);
  void judge_ring_cones();
  [[nodiscard]] bool is_clear_of(const Candidate& candidate);
  [[nodiscard]] bool meets_sweep_of(const Candidate& candidate, std::size_t k) const;
  [[nodiscard]] std::size_t next(std::size_t slot) const { return slot + 1 < ring_.size() ? slot + 1 : 0; }
  [[nodiscard]] std::size_t previous(std::size_t slot) const { return slot > 0 ? slot - 1 : ring_.size() - 1; }

  GuardedSurface& surface_;

  // The selected vertex.
  VertexId vertex_ = 0;
  Vec3 position_ = Vec3::Zero();
  Box reach_box_;  // of the star and the farthest target, in the grid's frame
  std::span<const VertexId> ring_;
  std::uint64_t ring_filter_ = 0;  // bit w % 64 is set for every ring vertex w: most others are told at once
  std::vector<Vec3> ring_points_;  // relative to position_
  std::vector<Candidate> candidates_;
  std::vector<std::pair<VertexId, int>> ring_order_;  // ring vertices and their places, sorted; only for long rings
  bool has_candidates_ = false;
  SweepSeparation separation_;

  // The target asked for last.
  Vec3 target_ = Vec3::Zero();
  Vec3 displacement_ = Vec3::Zero();
  double cone_margin_ = 0;     // of a normal's component, Å²
  std::vector<Vec3> normals_;  // of the star at the target, twice the area, Å²
  ConeAxis vertex_axis_{};     // after the move
  MovingStar scratch_star_;
  std::vector<ConeAxis> ring_axes_;  // after the move; zero where none was found
};

}  // namespace smopt
