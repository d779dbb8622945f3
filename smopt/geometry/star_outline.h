#pragma once

#include <array>
#include <span>

#include "smopt/geometry/lanes.h"
#include "smopt/geometry/triangle_batch.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// A star and its move as seen along an axis on which the star projects one-to-one before and after: what it sweeps over lies in a prism over
/// the polygon of its ring. Settles most triangles around the star without looking at the star's triangles one by one:
///
///  - Where the polygon is convex at a ring vertex w and lies within w's own angle, no triangle of w's star outside the moving star meets what
///    is swept elsewhere than in w or in an edge of the ring, if w's star projects one-to-one along the axis too: around w the triangle lies
///    outside the angle, so they share w alone, or the edge, and over these lies nothing else of either.
///  - A triangle beyond a side of the octagon around the polygon, or above or below all of it, does not meet what is swept.
///  - Where a line parts a triangle, seen along the axis, from a triangle of the star and its target, neither's vertex on it, the triangle does not
///    meet what that one sweeps. Tried are the sides of the one, the edges of the ring and the spokes of the star.
///
/// All by single-precision numbers with margins above their rounding.
class StarOutline {
 public:
  /// Stars of more triangles are left to others.
  static constexpr std::size_t kMaxValence = 14;

  /// \param ring          the ring relative to the moving vertex, Å; at most kMaxValence points.
  /// \param displacement  of the vertex, Å.
  /// \param up            the axis, of length 1.
  /// \param place         of the vertex relative to the centre of the batch whose entries will be asked about, Å.
  /// \param radius        no coordinate of these entries is larger, Å.
  void set(std::span<const Vec3> ring, const Vec3& displacement, const Eigen::Vector3f& up, const Vec3& place, float radius);

  /// Whether the outline is convex at ring vertex k and lies within its angle there.
  [[nodiscard]] bool is_convex_at(std::size_t k) const { return (convex_ >> k & 1) != 0; }

  /// Whether the triangle is proved to be beyond the prism.
  [[nodiscard]] bool is_clear_of(const TriangleBatch::Entry& triangle) const;

  /// Whether the triangle is proved to be anticlockwise as seen along the axis, and parted by lines from all of the star's triangles that have
  /// none of the ring vertices in `own` (a bit each).
  [[nodiscard]] bool is_parted_from_others(const TriangleBatch::Entry& triangle, unsigned own) const;

 private:
  static constexpr std::size_t kChunks = (kMaxValence + 2) / kLanes;
  /// Lower and upper end of the prism along one direction, with the margin.
  struct Extent {
    Floats low, high;
    [[nodiscard]] bool is_beyond(Floats projections) const { return is_set_in_all(projections > high) || is_set_in_all(projections < low); }
  };
  struct Projected {
    std::array<Floats, kChunks> x, y, z;
    std::size_t chunks;
  };

  void project(std::span<const Vec3> ring, const Vec3& displacement);
  [[nodiscard]] Extent extent(const std::array<float, 3>& direction, float place) const;
  void find_convex_corners();
  /// The ring's edges that have all three points strictly to their right, a bit each.
  [[nodiscard]] unsigned edges_left_of(Floats x, Floats y, float margin) const;
  /// The star's triangles that a spoke parts from the three points, a bit each.
  [[nodiscard]] unsigned triangles_beyond_spokes(Floats x, Floats y, float margin) const;
  /// Which of the star's triangles have one of the ring vertices.
  [[nodiscard]] unsigned triangles_with(unsigned vertices) const { return (vertices | vertices >> 1 | vertices << (valence_ - 1)) & all_; }
  /// The points that are not strictly to the left of the line through (x, y) along (dx, dy), a bit each.
  [[nodiscard]] unsigned not_left_of(float x, float y, float dx, float dy, float margin) const;

  std::array<Eigen::Vector3f, 3> frame_;  // across, across, up
  std::array<Floats, 9> rows_;            // the same, each coordinate in all lanes
  std::array<Extent, 5> extents_;         // along x, y, x + y, x − y, z of the frame
  std::size_t valence_ = 0;
  unsigned center_ = 0;                                        // the bits of the vertex and its target among the points
  unsigned all_ = 0;                                           // a bit per ring vertex, or per triangle of the star
  unsigned convex_ = 0;                                        // a bit per ring vertex
  std::array<Floats, kChunks> edge_x_, edge_y_, edge_offset_;  // edge k, from ring vertex k to the next: its vector and cross product
  Projected points_{};                                         // the ring, the target and the vertex itself, relative to the vertex
  float place_x_ = 0, place_y_ = 0;                            // of the vertex along the frame
  float margin_ = 0;                                           // of a coordinate along the frame, Å
  float radius_ = 0;                                           // no coordinate of the ring is larger, Å
};

}  // namespace smopt
