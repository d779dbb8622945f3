#include "experiments/level_set_run.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

/// One atom: its level set for any isovalue is a sphere.
Molecule one_atom(double radius) {
  return {{Vec3::Zero()}, {0.0}, {radius}};
}

/// φ = exp(-d(r² - R²)) = 1 where r = R.
LevelSet sphere_of_radius(double radius) {
  return LevelSet(one_atom(radius), {});
}

/// The mean of R - |p| over a sphere's inscribed mesh, as an integral over each triangle by the midpoint rule on 4^4 parts.
double mean_gap(const TriangleMesh& mesh, double radius) {
  constexpr int kParts = 64;
  double gap = 0, area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.points[a], u = (mesh.points[b] - p) / kParts, v = (mesh.points[c] - p) / kParts;
    const double part = u.cross(v).norm() / 2;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; i + j < kParts; ++j) {
        gap += part * (radius - (p + (i + 1.0 / 3) * u + (j + 1.0 / 3) * v).norm());
        area += part;
        if (i + j + 1 == kParts) continue;
        gap += part * (radius - (p + (i + 2.0 / 3) * u + (j + 2.0 / 3) * v).norm());
        area += part;
      }
    }
  }
  return gap / area;
}

TEST(LevelSetRun, OfAConcentricSphereIsTheDifferenceOfTheRadii) {
  const auto distance = sphere_of_radius(2).distance(testing::icosphere(5, 2.25), 5000);
  ASSERT_TRUE(distance);
  EXPECT_EQ(distance->unresolved, 0U);
  EXPECT_NEAR(distance->mean, 0.25, 1e-3) << "but for the sag of the triangles, below 2.25·(edge/radius)²/8";
  EXPECT_LE(distance->largest, 0.25 + 1e-9);
}

TEST(LevelSetRun, SeesTheTrianglesBetweenVerticesThatLieOnTheLevelSet) {
  const TriangleMesh mesh = testing::icosphere(2, 2);
  const auto distance = sphere_of_radius(2).distance(mesh, 50'000);
  ASSERT_TRUE(distance);
  const double expected = mean_gap(mesh, 2);
  EXPECT_GT(expected, 0.01);
  EXPECT_NEAR(distance->mean, expected, 2e-3 * expected);
}

TEST(LevelSetRun, CountsWhatHasNoFoot) {
  const auto distance = sphere_of_radius(2).distance(testing::icosphere(1, 1.0, {100, 0, 0}), 300);
  ASSERT_TRUE(distance);
  EXPECT_EQ(distance->unresolved, 300U) << "no atom reaches there";
}

TEST(LevelSetRun, HasNoDistanceOfAMeshThatIsNotFinite) {
  TriangleMesh mesh = testing::icosphere(1);
  mesh.points[0].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sphere_of_radius(2).distance(mesh, 100), std::nullopt);
  EXPECT_TRUE(to_json(std::optional<LevelSetDistance>()).is_null());
  EXPECT_EQ(to_json(LevelSetDistance{3, 2, 1}), nlohmann::ordered_json({{"mean", 2.0}, {"largest", 3.0}, {"unresolved", 1}}));
}

}  // namespace
}  // namespace smopt::experiments
