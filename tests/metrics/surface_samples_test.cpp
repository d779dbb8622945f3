#include "metrics/surface_samples.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

/// Half of the unit square as one triangle, the other half cut into 4^5.
TriangleMesh uneven_square() {
  TriangleMesh half = {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (int round = 0; round < 5; ++round) {
    TriangleMesh finer;
    for (const auto& [a, b, c] : half.triangles) {
      const Vec3 p = half.points[a], q = half.points[b], r = half.points[c];
      finer = joined(finer, {{p, q, r, (p + q) / 2, (q + r) / 2, (r + p) / 2}, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}});
    }
    half = finer;
  }
  return joined({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}}, half);
}

TEST(SurfaceSamples, StandForEqualPartsOfTheArea) {
  const auto samples = sample_surface(uneven_square(), 10'000);
  ASSERT_EQ(samples.size(), 10'000U);
  int in_large_triangle = 0;
  Vec3 sum = Vec3::Zero();
  double square_of_x = 0;
  for (const Vec3& p : samples) {
    in_large_triangle += p.y() < p.x() ? 1 : 0;
    sum += p;
    square_of_x += p.x() * p.x();
  }
  EXPECT_NEAR(in_large_triangle, 5000, 1);
  EXPECT_NEAR(sum.x() / 10'000, 0.5, 1e-3);
  EXPECT_NEAR(sum.y() / 10'000, 0.5, 1e-3);
  EXPECT_NEAR(square_of_x / 10'000, 1.0 / 3, 1e-3);
}

TEST(SurfaceSamples, LieOnTheSurface) {
  // The icosphere's triangles lie between the sphere of their inscribed circles and the circumscribed one.
  const TriangleMesh sphere = icosphere(2, 3.0);
  double nearest = 3;
  for (const auto& [a, b, c] : sphere.triangles)
    nearest = std::min(
        nearest,
        std::abs((sphere.points[b] - sphere.points[a]).cross(sphere.points[c] - sphere.points[a]).normalized().dot(sphere.points[a])));
  for (const Vec3& p : sample_surface(sphere, 5000)) {
    EXPECT_GE(p.norm(), nearest - 1e-12);
    EXPECT_LE(p.norm(), 3 + 1e-12);
  }
}

TEST(SurfaceSamples, AreNoneWhereThereIsNothingToSample) {
  EXPECT_TRUE(sample_surface({}, 10).empty());
  EXPECT_TRUE(sample_surface({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}, 10).empty()) << "no area";
  TriangleMesh unbounded = icosphere(0);
  unbounded.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(sample_surface(unbounded, 10).empty());
  unbounded.points[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(sample_surface(unbounded, 10).empty());
}

}  // namespace
}  // namespace smopt::metrics
