#include "smopt/improve/remesh/triangle_quality.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/improve/judge.h"

namespace smopt {
namespace {

constexpr double kTiny = 1e-12;

RemeshGoals only_angles(double smallest, double largest) {
  RemeshGoals goals;
  goals.min_angle_deg = smallest;
  goals.max_angle_deg = largest;
  goals.edge_ratio = 0;
  return goals;
}

TEST(TriangleQuality, OfAnEquilateralTriangleIsWhatItExceedsTheGoalsBy) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.5, std::sqrt(0.75), 0);
  EXPECT_NEAR(TriangleQuality(only_angles(30, 110)).of_triangle(a, b, c), 120.0 / 70, 1e-9) << "(180 − 60)/(180 − 110) is the least";
  EXPECT_NEAR(TriangleQuality(only_angles(40, 100)).of_triangle(a, b, c), 1.5, 1e-9) << "60/40 = 120/80";
  EXPECT_NEAR(TriangleQuality(only_angles(50, 100)).of_triangle(a, b, c), 1.2, 1e-9);
  EXPECT_NEAR(TriangleQuality({30, 110, 0.8, 30, 1}).of_triangle(a, b, c), 1 / 0.8, 1e-9);
}

TEST(TriangleQuality, OfARightIsoscelesTriangleIsThatOfItsWorstGoal) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_NEAR(TriangleQuality(only_angles(50, 100)).of_triangle(a, b, c), 0.9, 1e-9);
  EXPECT_NEAR(TriangleQuality(only_angles(30, 80)).of_triangle(a, b, c), 0.9, 1e-9);
  EXPECT_NEAR(TriangleQuality({30, 110, 0.8, 30, 1}).of_triangle(a, b, c), std::sqrt(0.5) / 0.8, 1e-9);
}

TEST(TriangleQuality, OfADegenerateTriangleIsZero) {
  const TriangleQuality quality{RemeshGoals{}};
  const Vec3 a(1, 2, 3), b(4, 5, 6);
  EXPECT_NEAR(quality.of_triangle(a, a, a), 0, kTiny);
  EXPECT_NEAR(quality.of_triangle(a, a, b), 0, kTiny);
  EXPECT_NEAR(quality.of_triangle(a, b, 0.5 * (a + b)), 0, 1e-6);
}

TEST(TriangleQuality, IsOneOrMoreExactlyWhereAllGoalsAreReached) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const RemeshGoals goals{25, 105, 0.5, 30, 1};
  const TriangleQuality quality(goals);
  int reached = 0, missed = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const Vec3 a = point(), b = point(), c = point();
    const auto angle = [](const Vec3& at, const Vec3& p, const Vec3& q) {
      return std::atan2((p - at).cross(q - at).norm(), (p - at).dot(q - at)) * 180 / std::numbers::pi;
    };
    const double largest = std::max({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
    const bool is_good = testing::smallest_angle_deg(a, b, c) >= 25 && largest <= 105 && testing::edge_ratio(a, b, c) >= 0.5;
    EXPECT_EQ(quality.of_triangle(a, b, c) >= 1, is_good) << a.transpose() << ", " << b.transpose() << ", " << c.transpose();
    EXPECT_NEAR(quality.of_triangle(a, b, c), quality.of_triangle(c, a, b), 1e-9);
    EXPECT_NEAR(quality.of_triangle(a, b, c), quality.of_triangle(8 * b, 8 * a, 8 * c), 1e-9);
    ++(is_good ? reached : missed);
  }
  EXPECT_GT(reached, 500);
  EXPECT_GT(missed, 500);
}

TEST(TriangleQuality, OfABendIsItsDihedralAngleOverTheGoal) {
  RemeshGoals goals;
  goals.min_dihedral_deg = 45;
  const TriangleQuality quality(goals);
  EXPECT_NEAR(quality.of_bend(1), 4, 1e-9) << "flat";
  EXPECT_NEAR(quality.of_bend(0), 2, 1e-9) << "a right angle";
  EXPECT_NEAR(quality.of_bend(-std::sqrt(0.5)), 1, 1e-9);
  EXPECT_NEAR(quality.of_bend(-1), 0, 1e-9) << "folded";
  EXPECT_NEAR(quality.of_bend(-1.0000001), 0, 1e-9) << "rounded beyond";
}

TEST(TriangleQuality, NeverMissesAGoalOfZero) {
  RemeshGoals goals;
  goals.edge_ratio = 0;
  goals.min_dihedral_deg = 0;
  const TriangleQuality quality(goals);
  EXPECT_GE(quality.of_bend(-0.999999), 1);
  EXPECT_GE(TriangleQuality({1e-6, 179.9999, 0, 0, 1}).of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1e-3, 0}), 1);
}

}  // namespace
}  // namespace smopt
