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
  /// \copydoc MoveGuard::must_wait  It would change more of the grid than the region has (see `TriangleGrid::needs_whole_grid`).
  [[nodiscard]] bool must_wait() const override;
  void apply() override;

 private:
  /// A bit for each ring vertex of a short ring, and one for the vertex itself: which of them a triangle has. Kept by a part of the vertex's
  /// number; a vertex that finds its place taken has no bit, and its triangles get the general treatment.
  class VertexBits {
   public:
    static constexpr unsigned kCenter = 1U << 31;
    VertexBits() { places_.fill({kFree, 0}); }
    void set(VertexId v, unsigned bit) {
      Place& place = places_[v % kPlaces];
      if (place.vertex == kFree) place = {v, bit};
    }
    void unset(VertexId v) { places_[v % kPlaces] = {kFree, 0}; }
    [[nodiscard]] unsigned of(const std::array<VertexId, 3>& t) const { return of(t[0]) | of(t[1]) | of(t[2]); }

   private:
    struct Place {
      VertexId vertex;
      unsigned bit;
    };
    [[nodiscard]] unsigned of(VertexId v) const {
      const Place& place = places_[v % kPlaces];
      return place.bit & (0U - static_cast<unsigned>(place.vertex == v));
    }
    static constexpr std::size_t kPlaces = 256;
    static constexpr VertexId kFree = 0xFFFFFFFF;
    std::array<Place, kPlaces> places_{};
  };
  /// What the last answer has found out about the star at the target.
  struct StarAtTarget {
    std::vector<Eigen::Vector3f> directions;  // of the normals, as `reliable_direction`
    NormalCone cone;                          // the vertex's
    std::vector<NormalCone> ring_cones;       // the ring vertices'
    bool is_projected = false;                // along the axis that the vertex had already, with room for rounding
    std::vector<Box> boxes;                   // of the triangles, in the grid's frame
    std::vector<char> leaves_home;            // whether the grid has to list a triangle elsewhere
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
  StarAtTarget at_target_;
  StarOutline outline_;
  bool has_outline_ = false;
  unsigned with_cone_ = 0;  // a bit per ring vertex: its cone is known
  VertexBits bits_;
  unsigned settled_ = 0;                    // ring vertices whose triangles need no look
  std::vector<std::uint32_t> star_places_;  // of the star's triangles in the surroundings
  struct Open {
    std::uint32_t place;  // in the surroundings
    unsigned own;         // ring vertices that the triangle has
  };
  std::vector<Open> open_;  // triangles that may be in the way
  bool is_separation_ready_ = false;
  SweepSeparation separation_;
  MovingStar scratch_star_;
};

}  // namespace smopt
