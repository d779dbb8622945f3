#include "smopt/geometry/triangle_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace smopt {
namespace {

using Corners = std::array<Vec3, 3>;
using Real = long double;

constexpr double kDegree = std::numbers::pi / 180;

Real distance(const Vec3& a, const Vec3& b) {
  return std::sqrt((b - a).cast<Real>().squaredNorm());
}

Real edge_ratio(const Corners& t) {
  const Real ab = distance(t[0], t[1]), bc = distance(t[1], t[2]), ca = distance(t[2], t[0]);
  return std::min({ab, bc, ca}) / std::max({ab, bc, ca});
}

Real angle_deg(const Vec3& apex, const Vec3& p, const Vec3& q) {
  const Eigen::Vector3<Real> u = (p - apex).cast<Real>(), v = (q - apex).cast<Real>();
  return std::atan2(std::sqrt(u.cross(v).squaredNorm()), u.dot(v)) * 180 / std::numbers::pi_v<Real>;
}

Real smallest_angle_deg(const Corners& t) {
  return std::min({angle_deg(t[0], t[1], t[2]), angle_deg(t[1], t[2], t[0]), angle_deg(t[2], t[0], t[1])});
}

/// Triangles of every shape: the third corner is drawn close to the line through the others as often as far from it.
class RandomTriangles {
 public:
  Corners operator()() {
    const Vec3 a = vector(), b = vector();
    const Vec3 c = a + uniform_(random_) * (b - a) + std::pow(10.0, -2 + 2 * uniform_(random_)) * vector();
    return {a, b, c};
  }
  Vec3 vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }

 private:
  std::mt19937 random_{29};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(QualityTest, FindsTheTrianglesBelowEitherThreshold) {
  RandomTriangles next;
  for (const QualityThresholds& limit : {QualityThresholds{}, QualityThresholds{0.3, 5}, QualityThresholds{0, 20},
                                         QualityThresholds{0.5, 0}, QualityThresholds{0.01, 59}, QualityThresholds{0, 0}}) {
    const QualityTest test(limit);
    int low = 0;
    for (int i = 0; i < 5000; ++i) {
      const Corners t = next();
      const Real ratio = edge_ratio(t), angle = smallest_angle_deg(t);
      if (std::abs(ratio - limit.edge_ratio) < 1e-9 || std::abs(angle - limit.min_angle_deg) < 1e-9) continue;
      const bool expected = ratio < limit.edge_ratio || angle < limit.min_angle_deg;
      low += static_cast<int>(expected);
      ASSERT_EQ(test.is_low(t[0], t[1], t[2]), expected) << "ratio " << ratio << ", angle " << angle << ", case " << i;
      ASSERT_EQ(test.is_low(t[2], t[0], t[1]), expected) << "turned";
      ASSERT_EQ(test.is_low(t[1], t[0], t[2]), expected) << "reversed";
    }
    EXPECT_EQ(low > 100, limit.edge_ratio > 0 || limit.min_angle_deg > 0);
  }
}

TEST(QualityTest, DegenerateTrianglesAreLow) {
  const QualityTest test({});
  EXPECT_TRUE(test.is_low({0, 0, 0}, {1, 0, 0}, {2, 0, 0})) << "collinear";
  EXPECT_TRUE(test.is_low({0, 0, 0}, {0, 0, 0}, {2, 0, 0})) << "two corners in one place";
  EXPECT_TRUE(test.is_low({1, 2, 3}, {1, 2, 3}, {1, 2, 3})) << "a point";
}

TEST(QualityTest, DoesNotDependOnScale) {
  const QualityTest test({0.1, 10});
  for (const double scale : {1e-6, 1.0, 1e6}) {
    EXPECT_FALSE(test.is_low({0, 0, 0}, {scale, 0, 0}, {0.5 * scale, 0.1 * scale, 0})) << "11.3 degrees";
    EXPECT_TRUE(test.is_low({0, 0, 0}, {scale, 0, 0}, {0.5 * scale, 0.08 * scale, 0})) << "9.1 degrees";
  }
}

TEST(TriangleShape, SquaredSineIsThatOfTheSmallestAngle) {
  RandomTriangles next;
  for (int i = 0; i < 5000; ++i) {
    const Corners t = next();
    const double sine = static_cast<double>(std::sin(smallest_angle_deg(t) * kDegree));
    ASSERT_NEAR(squared_sine_of_smallest_angle(t[0], t[1], t[2]), sine * sine, 1e-12) << "case " << i;
  }
  EXPECT_NEAR(squared_sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 0.75, 1e-15) << "equilateral";
}

TEST(TriangleShape, SquaredSineOfADegenerateTriangleIsZero) {
  EXPECT_EQ(squared_sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), 0);
  EXPECT_EQ(squared_sine_of_smallest_angle({1, 1, 1}, {1, 1, 1}, {3, 0, 0}), 0);
  EXPECT_EQ(squared_sine_of_smallest_angle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0);
}

TEST(TriangleShape, AreaVectorAndVolumeOfKnownTriangles) {
  EXPECT_EQ(doubled_area_vector({1, 1, 1}, {3, 1, 1}, {1, 4, 1}), Vec3(0, 0, 6));
  EXPECT_EQ(doubled_area_vector({1, 1, 1}, {1, 4, 1}, {3, 1, 1}), Vec3(0, 0, -6));
  EXPECT_EQ(sextuple_volume({1, 0, 0}, {0, 2, 0}, {0, 0, 3}), 6);
  EXPECT_EQ(sextuple_volume({0, 2, 0}, {1, 0, 0}, {0, 0, 3}), -6);
}

TEST(TriangleShape, DistanceToASegmentCountsStrictlyBetweenItsEnds) {
  const Vec3 a(1, 1, 1), b(5, 1, 1);
  EXPECT_DOUBLE_EQ(distance_to_open_segment({2, 4, 5}, a, b), 5);
  EXPECT_DOUBLE_EQ(distance_to_open_segment({2, 1, 1}, a, b), 0);
  EXPECT_EQ(distance_to_open_segment({1, 2, 1}, a, b), HUGE_VAL) << "beside an end";
  EXPECT_EQ(distance_to_open_segment({5, 2, 1}, a, b), HUGE_VAL);
  EXPECT_EQ(distance_to_open_segment({0, 1, 1}, a, b), HUGE_VAL) << "beyond an end";
  EXPECT_EQ(distance_to_open_segment({7, 1, 1}, a, b), HUGE_VAL);
  EXPECT_EQ(distance_to_open_segment({1, 1, 1}, a, a), HUGE_VAL) << "a segment of no length";
}

TEST(TriangleShape, DistanceToASegmentIsThatToItsNearestPoint) {
  RandomTriangles next;
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Corners t = next();
    const double found = distance_to_open_segment(t[2], t[0], t[1]);
    if (found == HUGE_VAL) continue;
    ++inside;
    Real nearest = HUGE_VALL;
    for (int k = 0; k <= 2000; ++k) nearest = std::min(nearest, distance(t[2], t[0] + k / 2000.0 * (t[1] - t[0])));
    EXPECT_NEAR(found, static_cast<double>(nearest), 1e-3);
    EXPECT_LE(found, static_cast<double>(nearest) + 1e-12);
  }
  EXPECT_GT(inside, 50);
}

}  // namespace
}  // namespace smopt
