#include "smopt/improve/remesh/convex_piece.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace smopt {
namespace {

/// Of a flat convex polygon in any plane.
double area(const ConvexPiece& piece) {
  Vec3 doubled = Vec3::Zero();
  for (std::size_t i = 2; i < piece.count; ++i)
    doubled += (piece.corners[i - 1] - piece.corners[0]).cross(piece.corners[i] - piece.corners[0]);
  return 0.5 * doubled.norm();
}

/// Splits a piece and its parts again and again: the areas add up, and no part has too many corners.
void expect_parts_make_the_whole(const ConvexPiece& piece, const Corners& nearest, double reach, int levels, const std::string& what) {
  if (levels == 0 || area(piece) < 1e-9) return;
  const auto [over, beside] = split(piece, nearest, reach);
  ASSERT_LE(over.count, ConvexPiece::kMostCorners) << what;
  ASSERT_LE(beside.count, ConvexPiece::kMostCorners) << what;
  ASSERT_NEAR(area(over) + area(beside), area(piece), 1e-12) << what << ", level " << levels;
  expect_parts_make_the_whole(over, nearest, reach, levels - 1, what);
  expect_parts_make_the_whole(beside, nearest, reach, levels - 1, what);
}

TEST(ConvexPiece, IsTheWholeOfItsPartsWhereCutsGoThroughCorners) {
  const Corners square_half{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  const Corners middle{Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};  // its edges go through the other's corners or middles
  expect_parts_make_the_whole(ConvexPiece(square_half), middle, 1e-3, 10, "an eighth");
  expect_parts_make_the_whole(ConvexPiece(square_half), Corners{Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0, 2, 0)}, 1e-3, 10, "a half");
  expect_parts_make_the_whole(ConvexPiece(square_half), Corners{Vec3(9, 9, 9), Vec3(9, 9, 9), Vec3(9, 9, 9)}, 1, 10, "a point");
}

TEST(ConvexPiece, IsTheWholeOfItsPartsForRandomTriangles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 200; ++i) {
    const Corners piece{point(), point(), point()}, nearest{point(), point(), point()};
    expect_parts_make_the_whole(ConvexPiece(piece), nearest, 0.01, 8, "case " + std::to_string(i));
  }
}

TEST(ConvexPiece, FirstPartLiesOverTheTriangleThatThePieceReachesOutOf) {
  const Corners triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const ConvexPiece piece(Corners{Vec3(0.1, 0.1, 0.2), Vec3(5, 0.2, 0.2), Vec3(0.1, 0.3, 0.2)});
  const auto [over, beside] = split(piece, triangle, 0.1);
  for (const Vec3& p : over) EXPECT_LE(p[0] + p[1], 1 + 1e-12);
  for (const Vec3& p : beside) EXPECT_GE(p[0] + p[1], 1 - 1e-12);
  EXPECT_TRUE(is_within(over, PointToTriangle(triangle), 0.2 * 0.2 + 1e-12));
  EXPECT_FALSE(is_within(beside, PointToTriangle(triangle), 0.3));
}

}  // namespace
}  // namespace smopt
