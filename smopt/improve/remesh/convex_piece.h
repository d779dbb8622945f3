#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "smopt/geometry/vec3.h"
#include "smopt/improve/remesh/point_to_triangle.h"

namespace smopt {

/// A part of a triangle: a convex polygon of a few corners. What is convex in space (the distance to a triangle) is largest at a corner.
struct ConvexPiece {
  /// A cut gives each part at most one corner more; pieces with this many are cut between corners.
  static constexpr std::size_t kMostCorners = 8;

  ConvexPiece() = default;
  explicit ConvexPiece(const Corners& t) : corners{t[0], t[1], t[2]}, count(3) {}

  [[nodiscard]] const Vec3* begin() const { return corners.data(); }
  [[nodiscard]] const Vec3* end() const { return corners.data() + count; }
  void add(const Vec3& corner) { corners[count++] = corner; }

  /// The mean of the corners, and the distance from it to the farthest of them.
  [[nodiscard]] Vec3 center() const;
  [[nodiscard]] double radius_around(const Vec3& point) const;

  std::array<Vec3, kMostCorners> corners;
  std::size_t count = 0;
};

/// Whether the piece is within a distance (given squared) of a triangle. No piece with a corner that is not finite is.
bool is_within(const ConvexPiece& piece, const PointToTriangle& triangle, double distance2);

/// The largest distance (squared) of the piece from a triangle.
double farthest_squared(const ConvexPiece& piece, const PointToTriangle& triangle);

/// Cuts a piece in two so that both are easier to prove to be near triangles: where it reaches out sideways beyond `nearest`, along the plane
/// through that edge square to the triangle, so that the first part is the one over the triangle; elsewhere in the middle of its longest extent.
/// Each point of the piece is within 4 · 2⁻⁵³ · (largest coordinate) of the two parts.
/// \param nearest  the triangle nearest to the piece's centre
/// \param reach    Å; reaching out by less than half of it is not worth a cut
std::pair<ConvexPiece, ConvexPiece> split(const ConvexPiece& piece, const Corners& nearest, double reach);

}  // namespace smopt
