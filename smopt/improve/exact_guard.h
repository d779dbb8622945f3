#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "smopt/geometry/star_outline.h"
#include "smopt/geometry/sweep_separation.h"
#include "smopt/geometry/triangle_batch.h"
#include "smopt/improve/move_guard.h"
#include "smopt/improve/star_judge.h"
#include "smopt/improve/vertex_bits.h"

namespace smopt {

/// Decides whether a vertex may move, against the whole surface and exactly; the guarantee of the project rests on this class.
///
/// A move of v from x to x' sweeps, for each triangle (v, a, b) of its star, the tetrahedron (a, b, x, x'). It is refused when
///  - a triangle outside the star meets one of these tetrahedra elsewhere than in a shared vertex or edge (so it neither ends in an
///    intersection nor passes through another sheet nor swallows a component), or
///  - the star folds onto itself at the end or on the way, or
///  - a triangle of the star would be degenerate (exactly collinear).
/// The decision takes four steps, each for what the one before left open:
///  1. normal cones: a vertex keeps an axis on which all triangles of its star have a positive component and around which the star turns
///     once. The star then projects one-to-one along the axis, and as the component is linear in the moving point, it does so all the way if
///     it does at both ends: triangles that share the vertex cannot meet elsewhere;
///  2. the star's outline along that axis: it settles most triangles around the ring, and most others near the star (`StarOutline`);
///  3. separating planes in floating point with a rounding margin;
///  4. exact predicates.
/// Several guards may work on one surface at the same time when each keeps to a region of its own (see `enter`).
/// Cost: about a microsecond a move.
class ExactGuard final : public MoveGuard {
 public:
  explicit ExactGuard(GuardedSurface& surface) : surface_(surface), star_(surface) {}

  void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) override;
  void select(const StarMove& move, const Vec3& reach) override;
  [[nodiscard]] bool is_within_region() const override;
  [[nodiscard]] bool is_ok() override;
  /// \copydoc MoveGuard::must_wait  It would change more of the grid than the region has (see `TriangleGrid::needs_whole_grid`).
  [[nodiscard]] bool must_wait() const override;
  void apply() override;

 private:
  /// A triangle that may be in the way.
  struct Open {
    std::uint32_t place;  // in the surroundings
    unsigned own;         // ring vertices that it has, a bit each
  };

  void fetch_surroundings();
  void draw_outline();
  void sort_surroundings();
  [[nodiscard]] bool is_clear_of_surroundings();
  [[nodiscard]] bool is_clear_by_outline(const TriangleBatch::Entry& triangle, unsigned own) const;
  [[nodiscard]] bool is_clear_of(const TriangleBatch::Entry& triangle);
  void prepare_separation();
  void compute_boxes();
  [[nodiscard]] Vec3 mean_normal() const;
  [[nodiscard]] int slot_of(VertexId w) const;
  [[nodiscard]] bool meets_sweep_of(const Triangle& t, const std::array<int, 3>& slots, std::size_t k) const;
  [[nodiscard]] Box star_box(VertexId v) const;

  static constexpr int kNotOnRing = -1;

  GuardedSurface& surface_;
  std::span<const VertexId> group_;
  const TriangleGrid::CubeRange* region_ = nullptr;
  TriangleBatch surroundings_;

  // The selected vertex.
  const StarMove* move_ = nullptr;
  Box reach_box_;                                     // of the star and the farthest target, in the grid's frame
  std::vector<Box> ring_boxes_;                       // of the ring's points
  std::vector<std::pair<VertexId, int>> ring_order_;  // ring vertices and their places, sorted; only for long rings

  // The target asked for last.
  StarJudge star_;
  StarOutline outline_;
  bool has_outline_ = false;
  VertexBits bits_;                         // of the vertex and, where there is an outline, of its ring
  unsigned with_cone_ = 0;                  // ring vertices whose cone is known, a bit each
  unsigned settled_ = 0;                    // ring vertices whose triangles need no look
  std::vector<std::uint32_t> star_places_;  // of the star's triangles in the surroundings
  std::vector<Open> open_;
  bool is_separation_ready_ = false;
  SweepSeparation separation_;
  std::vector<Box> new_boxes_;     // of the star's triangles, in the grid's frame
  std::vector<char> leaves_home_;  // per triangle of the star: whether the grid has to list it elsewhere
};

}  // namespace smopt
