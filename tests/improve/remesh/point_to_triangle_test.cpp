#include "smopt/improve/remesh/point_to_triangle.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace smopt {
namespace {

using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;

Exact::Point_3 exact(const Vec3& p) {
  return {p[0], p[1], p[2]};
}

double exact_distance(const Vec3& p, const Corners& t) {
  return std::sqrt(CGAL::to_double(CGAL::squared_distance(exact(p), Exact::Triangle_3(exact(t[0]), exact(t[1]), exact(t[2])))));
}

/// Never understated, never overstated by more than the tolerance; the certificate the other way round.
void expect_near_exact(const Vec3& p, const Corners& t, double tolerance, const std::string& what) {
  constexpr double kRounding = 1e-14;
  const double truth = exact_distance(p, t);
  const PointToTriangle triangle(t);
  const double distance = std::sqrt(triangle.squared_distance(p));
  EXPECT_GE(distance, truth - kRounding) << what;
  EXPECT_LE(distance, truth + tolerance) << what;
  EXPECT_LE(triangle.distance_below(p), truth + kRounding) << what;
}

TEST(PointToTriangle, IsTheExactDistanceForPointsAllAround) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 500; ++i) {
    const Corners t{point(), point(), point()};
    const Vec3 p = 2 * point();
    expect_near_exact(p, t, 1e-12, "case " + std::to_string(i));
    EXPECT_NEAR(PointToTriangle(t).distance_below(p), exact_distance(p, t), 1e-12) << i;
  }
}

TEST(PointToTriangle, IsNeverUnderstatedOnNeedles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = point(), b = point();
    const double height = std::pow(10.0, -(i % 17));
    const Corners needle{a, b, a + uniform(random) * (b - a) + height * point()};
    const Vec3 beside = a + uniform(random) * (b - a) + 2 * height * point();
    expect_near_exact(point(), needle, 1e-7, "far, case " + std::to_string(i));
    expect_near_exact(beside, needle, 1e-7, "beside, case " + std::to_string(i));
  }
}

TEST(PointToTriangle, OfOneWithoutAnAreaIsThatOfTheSegmentOrPoint) {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(1, 0, 0), p(1.5, 3, 4);
  for (const Corners& t : {Corners{a, b, c}, Corners{a, c, b}, Corners{c, a, b}, Corners{a, b, b}, Corners{b, a, b}, Corners{a, a, b}})
    EXPECT_DOUBLE_EQ(PointToTriangle(t).squared_distance(p), 25);
  EXPECT_DOUBLE_EQ(PointToTriangle({c, c, c}).squared_distance(p), 25.25);
}

TEST(PointToTriangle, OfAPointThatIsNotFiniteIsInfinite) {
  for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_FALSE(PointToTriangle({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}).squared_distance(Vec3(x, 0, 0)) < HUGE_VAL) << x;
}

}  // namespace
}  // namespace smopt
