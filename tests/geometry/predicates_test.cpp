#include "smopt/geometry/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

constexpr std::uint32_t kSeed = 20170907;

/// Calls check(points) with random lattice points of every kind.
template <std::size_t kCount, class Check>
void for_random_points(int cases, const Check& check) {
  for (const LatticePoints::Kind& kind : lattice_kinds()) {
    SCOPED_TRACE(kind.name);
    LatticePoints point(kind, kSeed);
    for (int i = 0; i < cases / kThinning; ++i) {
      std::array<Vec3, kCount> points;
      for (Vec3& p : points) p = point();
      check(points);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(Predicates, Orient3dHasTheSignOfTheRationalDeterminant) {
  std::map<int, int> seen;
  for_random_points<4>(4000, [&](const auto& p) {
    const int expected = rational_orient3d(p[0], p[1], p[2], p[3]);
    ++seen[expected];
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected);
    ASSERT_EQ(exact_orient3d(p[0], p[1], p[2], p[3]), expected);
  });
  for (const int sign : {-1, 0, 1}) EXPECT_GT(seen[sign], 1000 / kThinning) << "the cases do not try sign " << sign;
}

TEST(Predicates, Orient3dOfAPointRoundedOntoThePlane) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double offset : {0.0, 100.0, 1e6}) {
      for (int i = 0; i < 3000; ++i) {
        const Vec3 shift = Vec3::Constant(offset);
        const Vec3 a = scale * point() + shift, b = scale * point() + shift, c = scale * point() + shift;
        const Vec3 d = a + uniform(random) * (b - a) + uniform(random) * (c - a);
        ASSERT_EQ(orient3d(a, b, c, d), rational_orient3d(a, b, c, d)) << "scale " << scale << ", offset " << offset << ", case " << i;
      }
    }
  }
}

TEST(Predicates, Orient3dChangesSignWithEverySwapAndTurnsWithTheCorners) {
  for_random_points<4>(500, [](const auto& p) {
    const int sign = orient3d(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(orient3d(p[1], p[0], p[2], p[3]), -sign);
    ASSERT_EQ(orient3d(p[0], p[1], p[3], p[2]), -sign);
    ASSERT_EQ(orient3d(p[3], p[1], p[2], p[0]), -sign);
    ASSERT_EQ(orient3d(p[1], p[2], p[0], p[3]), sign);
  });
}

TEST(Predicates, Orient3dPointsAlongTheNormalOfAnAnticlockwiseTriangle) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, -3, 0}), 0);
}

TEST(Predicates, Orient2dHasTheSignOfTheRationalArea) {
  for_random_points<3>(4000, [](const auto& p) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const int expected = rational_orient2d(p[0][u], p[0][v], p[1][u], p[1][v], p[2][u], p[2][v]);
      ASSERT_EQ(orient2d(p[0][u], p[0][v], p[1][u], p[1][v], p[2][u], p[2][v]), expected);
      ASSERT_EQ(orient2d_along(axis, p[0], p[1], p[2]), expected);
    }
  });
}

TEST(Predicates, SignsAreExactWhereProductsUnderflowOrOverflow) {
  for (const double scale : {1e-300, 1e-150, 1e-105, 1e105, 1e150, 1e300}) {
    LatticePoints point({"any", 4, scale, 0.0, false, true}, kSeed);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a = point(), b = point(), c = point(), d = point();
      ASSERT_EQ(orient3d(a, b, c, d), rational_orient3d(a, b, c, d)) << "scale " << scale << ", case " << i;
      ASSERT_EQ(orient2d_along(0, a, b, c), rational_orient2d(a[1], a[2], b[1], b[2], c[1], c[2])) << "scale " << scale << ", case " << i;
    }
  }
}

TEST(Predicates, CollinearPointsAreToldFromNearlyCollinearOnes) {
  int collinear = 0;
  for_random_points<3>(4000, [&](const auto& p) {
    const bool expected = are_rationally_collinear(p[0], p[1], p[2]);
    collinear += static_cast<int>(expected);
    ASSERT_EQ(are_collinear(p[0], p[1], p[2]), expected);
    ASSERT_EQ(projection_axis(p[0], p[1], p[2]) < 0, expected);
  });
  EXPECT_GT(collinear, 1000 / kThinning);
}

TEST(Predicates, CollinearInTwoProjectionsIsNotCollinear) {
  EXPECT_EQ(projection_axis({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0);
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 0, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 2);
  EXPECT_FALSE(are_collinear({1e6, 0.1, 0}, {1e6, 0.2, 0}, {std::nextafter(1e6, 2e6), 0.3, 0}));
}

TEST(Predicates, SectorIsTouchedOnTheWayAsTheRationalMomentSays) {
  std::map<bool, int> seen;
  for_random_points<5>(2000, [&](const auto& p) {
    const auto& [a, b, c, x, x_new] = p;
    const int before = rational_orient3d(a, b, c, x), after = rational_orient3d(a, b, c, x_new);
    if (before * after > 0 || (before == 0 && after == 0)) return;
    const bool expected = sector_is_touched(a, b, c, x, x_new);
    ++seen[expected];
    ASSERT_EQ(touches_sector_on_the_way(a, b, c, x, x_new), expected);
    ASSERT_EQ(touches_sector_on_the_way(b, a, c, x, x_new), expected) << "the sector has no first side";
    ASSERT_EQ(touches_sector_on_the_way(a, b, c, x_new, x), expected) << "the moment is the same on the way back";
  });
  EXPECT_GT(seen[true], 500 / kThinning);
  EXPECT_GT(seen[false], 500 / kThinning);
}

}  // namespace
}  // namespace smopt
