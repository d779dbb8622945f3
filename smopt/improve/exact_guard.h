#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "smopt/geometry/normal_cone.h"
#include "smopt/geometry/star_outline.h"
#include "smopt/geometry/sweep_separation.h"
#include "smopt/geometry/triangle_batch.h"
#include "smopt/improve/move_guard.h"

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
  explicit ExactGuard(GuardedSurface& surface) : surface_(surface) {}

  void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) override;
  void select(const StarMove& move, const Vec3& reach) override;
  [[nodiscard]] bool is_within_region() const override;
  [[nodiscard]] bool is_ok() override;
  /// \copydoc MoveGuard::must_wait  It would need a new block of the grid (see `TriangleGrid::needs_new_block`).
  [[nodiscard]] bool must_wait() const override;
  void apply() override;

 private:
  /// Vertices by a part of their number: tells at once, and without fail, which corners of a triangle are marked; a vertex that finds its
  /// place taken stays unmarked.
  class VertexMarks {
   public:
    VertexMarks() { places_.fill(kFree); }
    void mark(VertexId v) {
      if (places_[v % kPlaces] == kFree) places_[v % kPlaces] = v;
    }
    void unmark(VertexId v) {
      if (places_[v % kPlaces] == v) places_[v % kPlaces] = kFree;
    }
    [[nodiscard]] bool has_any_of(const std::array<VertexId, 3>& t) const {
      return static_cast<bool>((places_[t[0] % kPlaces] == t[0]) | (places_[t[1] % kPlaces] == t[1]) | (places_[t[2] % kPlaces] == t[2]));
    }

   private:
    static constexpr std::size_t kPlaces = 256;
    static constexpr VertexId kFree = 0xFFFFFFFF;
    std::array<VertexId, kPlaces> places_{};
  };
  /// What the last answer has found out about the star at the target.
  struct StarAtTarget {
    std::vector<Eigen::Vector3f> directions;  // of the normals, as `reliable_direction`
    NormalCone cone;                          // the vertex's
    std::vector<NormalCone> ring_cones;       // the ring vertices'
    bool is_projected = false;                // along the axis that the vertex had already, with room for rounding
    std::vector<Box> boxes;                   // of the triangles, in the grid's frame
  };

  void fetch_surroundings();
  void judge_star();
  [[nodiscard]] bool is_star_ok();
  [[nodiscard]] bool is_fold_free_at_target() const;
  [[nodiscard]] bool is_fold_free_on_the_way() const;
  [[nodiscard]] NormalCone find_own_cone();
  [[nodiscard]] NormalCone find_ring_cone(std::size_t slot);
  void judge_ring_cones();
  void draw_outline();
  [[nodiscard]] bool is_ring_vertex_seen_along(VertexId w, const Eigen::Vector3f& axis) const;
  [[nodiscard]] bool is_clear_of_surroundings();
  [[nodiscard]] bool is_clear_by_outline(const TriangleBatch::Entry& triangle) const;
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
  std::vector<std::pair<VertexId, int>> ring_order_;  // ring vertices and their places, sorted; only for long rings

  // The target asked for last.
  StarAtTarget at_target_;
  StarOutline outline_;
  bool has_outline_ = false;
  unsigned seen_ = 0;                     // a bit per ring vertex: its star is seen one-to-one along the outline's axis too
  VertexMarks settled_;                   // the vertex, and ring vertices whose triangles need no look
  std::vector<std::size_t> star_places_;  // of the star's triangles in the surroundings
  bool is_separation_ready_ = false;
  SweepSeparation separation_;
  MovingStar scratch_star_;
};

}  // namespace smopt
