#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Proves, in single precision with a rounding margin, that triangles near a moving star stay clear of what the star sweeps over.
///
/// The star's triangle k = (ring[k], ring[k + 1], centre) sweeps the hull of these three and the centre's target. A candidate triangle is
/// clear of it when some axis separates their projections by more than the margin. Tried in turn: the coordinate axes (boxes), the edges of
/// the candidate as seen along `up` (the star's mean normal, so that these are cuts at right angles to the surface), the candidate's
/// normal, `up` itself, then for what is left the sweep's own edges and normal. An axis is tried against the whole ring at once, four
/// triangles of the star an instruction.
class SweepSeparation {
 public:
  /// Coordinates relative to the centre, Å.
  using Corners = std::array<Eigen::Vector3f, 3>;

  /// Starts with a new star. `ring` holds the ring's points relative to the centre.
  void set_star(const std::vector<Vec3>& ring);
  /// `displacement` of the centre; `up` of any length but zero.
  void set_target(const Vec3& displacement, const Vec3& up);

  /// Marks which of the star's triangles are in question for the candidate to come; all are to begin with.
  void open_all();
  void close(std::size_t k) { open_[k / kLanes][k % kLanes] = 0; }
  [[nodiscard]] bool is_open(std::size_t k) const { return open_[k / kLanes][k % kLanes] != 0; }

  /// Closes those of the open triangles whose sweep the candidate is proved to be clear of; true when none is left open.
  bool separate(const Corners& candidate);

 private:
  static constexpr std::size_t kLanes = 4;
  using Floats = float __attribute__((vector_size(16)));
  using Masks = std::int32_t __attribute__((vector_size(16)));
  /// Three coordinates of four points.
  struct Points {
    Floats x, y, z;
  };

  /// A candidate with what all its tests need.
  struct Measured {
    const Corners& corners;
    Eigen::Vector3f low, high;
    float margin_rel = 0;  // margin of a projection on an axis with |axis|₁ = 1, Å
  };

  void compare_boxes(const Measured& candidate);
  void try_axis(const Eigen::Vector3f& axis, const Measured& candidate);
  bool try_own_axes(std::size_t k, const Measured& candidate);
  [[nodiscard]] bool is_any_open() const;
  [[nodiscard]] Eigen::Vector3f ring_point(std::size_t k) const;

  std::size_t size_ = 0;
  std::vector<Points> ring_;       // point k in lane k % 4 of chunk k / 4
  std::vector<Points> ring_next_;  // point k + 1
  std::vector<Points> box_low_;    // of what triangle k sweeps
  std::vector<Points> box_high_;
  std::vector<Masks> open_;  // per triangle of the star: all bits set while in question
  std::vector<Masks> all_;   // the same, for all triangles
  Eigen::Vector3f displacement_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f up_ = Eigen::Vector3f::UnitZ();
  float ring_radius_ = 0;  // largest coordinate of the ring
  float radius_ = 0;       // and of the displacement
};

}  // namespace smopt
