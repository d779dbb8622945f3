#include "smopt/geometry/box.h"

#include <gtest/gtest.h>

#include <random>

namespace smopt {
namespace {

TEST(Box, RoundsOutwardsByLittle) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> mantissa(1, 2), exponent(-140, 120);
  for (int i = 0; i < 100000; ++i) {
    const double x = (i % 2 == 0 ? 1 : -1) * std::ldexp(mantissa(random), static_cast<int>(exponent(random)));
    const double low = rounded_down(x), high = rounded_up(x);
    ASSERT_LT(low, x);
    ASSERT_GT(high, x);
    ASSERT_LE(high - low, 4e-7 * std::abs(x) + 3e-38) << "too far outwards to be of use";
  }
}

TEST(Box, RoundsOutwardsAroundPowersOfTwoAndZero) {
  for (int exponent = -148; exponent < 127; ++exponent) {
    for (const double sign : {-1.0, 1.0}) {
      const double power = sign * std::ldexp(1.0, exponent);
      for (const double x : {power, std::nextafter(power, HUGE_VAL), std::nextafter(power, -HUGE_VAL)}) {
        EXPECT_LT(double{rounded_down(x)}, x);
        EXPECT_GT(double{rounded_up(x)}, x);
      }
    }
  }
  EXPECT_LE(double{rounded_down(0.0)}, 0.0);
  EXPECT_GE(double{rounded_up(0.0)}, 0.0);
  EXPECT_LE(double{rounded_down(1e-300)}, 1e-300);
  EXPECT_GE(double{rounded_up(1e-300)}, 1e-300);
}

TEST(Box, ContainsTheTriangleItWasMadeFrom) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double scale : {1e-6, 1.0, 1e6, 1e30}) {
    for (int i = 0; i < 1000; ++i) {
      const auto point = [&] { return Vec3(scale * Vec3(uniform(random), uniform(random), uniform(random))); };
      const std::array<Vec3, 3> t{point(), point(), point()};
      const Box box = triangle_box(t[0], t[1], t[2]);
      for (const Vec3& p : t) {
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_LE(double{box.low[axis]}, p[axis]);
          ASSERT_GE(double{box.high[axis]}, p[axis]);
        }
      }
    }
  }
}

TEST(Box, OverlapCountsContactAndKnowsEveryAxis) {
  const Box unit = make_box(Vec3::Zero(), Vec3::Ones());
  EXPECT_TRUE(unit.overlaps(unit));
  EXPECT_TRUE(unit.overlaps(make_box(Vec3::Constant(0.4), Vec3::Constant(0.6)))) << "inside";
  EXPECT_TRUE(unit.overlaps(make_box(Vec3::Ones(), Vec3::Constant(2)))) << "a corner";
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.1, 1.1}) {
      const Vec3 shift = side * Vec3::Unit(axis);
      EXPECT_FALSE(unit.overlaps(make_box(shift, shift + Vec3::Ones()))) << "axis " << axis;
    }
  }
}

TEST(Box, TheEmptyBoxOverlapsNothing) {
  EXPECT_FALSE(Box{}.overlaps(Box{}));
  EXPECT_FALSE(Box{}.overlaps(make_box(Vec3::Constant(-1e30), Vec3::Constant(1e30))));
}

}  // namespace
}  // namespace smopt
