#include "smopt/improve/remesh/convex_piece.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace smopt {
namespace {

/// A corner that is farther than the reach from a triangle lies outside its prism by more than half of the reach, unless it is higher over it
/// than 0.87 of the reach: then a cut beside it is of no help.
constexpr double kOutsidePerReach = 0.5;
/// The part over the triangle must be more than rounding: its depth relative to the reach.
constexpr double kInsidePerReach = 1e-3;

/// Per corner: on which side of a plane, and how far; negative for the first part.
using Sides = std::array<double, ConvexPiece::kMostCorners>;

template <class Offset>
Sides sides_by(const ConvexPiece& piece, const Offset& offset) {
  Sides sides{};
  for (std::size_t i = 0; i < piece.count; ++i) sides[i] = offset(piece.corners[i]);
  return sides;
}

/// The plane of the prism over the triangle that the piece reaches out of farthest; nothing where it does not, or lies outside altogether.
std::optional<Sides> sides_of_prism(const ConvexPiece& piece, const Corners& t, double reach) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  std::optional<Sides> best;
  double farthest = kOutsidePerReach * reach;
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 outward = (t[(e + 1) % 3] - t[e]).cross(normal).normalized();
    const Sides sides = sides_by(piece, [&](const Vec3& p) { return outward.dot(p - t[e]); });
    const auto [low, high] = std::minmax_element(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(piece.count));
    if (!(*high > farthest && *low < -kInsidePerReach * reach)) continue;
    farthest = *high;
    best = sides;
  }
  return best;
}

Sides sides_of_middle(const ConvexPiece& piece) {
  Vec3 low = piece.corners[0], high = piece.corners[0];
  for (const Vec3& p : piece) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const double middle = 0.5 * (low[axis] + high[axis]);
  return sides_by(piece, [&](const Vec3& p) { return p[axis] - middle; });
}

/// Between the first corner and the one opposite.
Sides sides_of_chord(const ConvexPiece& piece) {
  const std::size_t opposite = piece.count / 2;
  Sides sides{};
  for (std::size_t i = 1; i < piece.count; ++i) sides[i] = i < opposite ? -1 : (i > opposite ? 1 : 0);
  return sides;
}

/// Of the polygon's outline; two, or none where the plane goes through corners. More only by rounding, on slivers.
std::size_t crossings(const ConvexPiece& piece, const Sides& sides) {
  std::size_t changes = 0;
  for (std::size_t i = 0; i < piece.count; ++i) changes += sides[i] * sides[i + 1 < piece.count ? i + 1 : 0] < 0 ? 1 : 0;
  return changes;
}

/// The two parts' outlines together contain the piece's; as both are convex, they cover it, whatever the sides are.
std::pair<ConvexPiece, ConvexPiece> cut(const ConvexPiece& piece, const Sides& sides) {
  std::pair<ConvexPiece, ConvexPiece> parts;
  for (std::size_t i = 0; i < piece.count; ++i) {
    const std::size_t j = i + 1 < piece.count ? i + 1 : 0;
    if (sides[i] <= 0) parts.first.add(piece.corners[i]);
    if (sides[i] >= 0) parts.second.add(piece.corners[i]);
    if (!(sides[i] < 0 && sides[j] > 0) && !(sides[i] > 0 && sides[j] < 0)) continue;
    const Vec3 crossing = piece.corners[i] + sides[i] / (sides[i] - sides[j]) * (piece.corners[j] - piece.corners[i]);
    parts.first.add(crossing);
    parts.second.add(crossing);
  }
  return parts;
}

}  // namespace

Vec3 ConvexPiece::center() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : *this) sum += p;
  return sum / static_cast<double>(count);
}

double ConvexPiece::radius_around(const Vec3& point) const {
  double radius2 = 0;
  for (const Vec3& p : *this) radius2 = std::max(radius2, (p - point).squaredNorm());
  return std::sqrt(radius2);
}

bool is_within(const ConvexPiece& piece, const PointToTriangle& triangle, double distance2) {
  return std::all_of(piece.begin(), piece.end(), [&](const Vec3& p) { return triangle.squared_distance(p) <= distance2; });
}

double farthest_squared(const ConvexPiece& piece, const PointToTriangle& triangle) {
  double farthest2 = 0;
  for (const Vec3& p : piece) farthest2 = std::max(farthest2, triangle.squared_distance(p));
  return farthest2;
}

std::pair<ConvexPiece, ConvexPiece> split(const ConvexPiece& piece, const Corners& nearest, double reach) {
  if (piece.count == ConvexPiece::kMostCorners) return cut(piece, sides_of_chord(piece));
  const Sides sides = sides_of_prism(piece, nearest, reach).value_or(sides_of_middle(piece));
  return cut(piece, crossings(piece, sides) <= 2 ? sides : sides_of_chord(piece));
}

}  // namespace smopt
