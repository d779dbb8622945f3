#include "metrics/distance.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

SurfaceDistance distance(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<std::string> notes;
  return surface_distance(a, b, notes, {.samples = 20'000}).value();
}

TriangleMesh square(double z, double size = 1) {
  return {{{0, 0, z}, {size, 0, z}, {size, size, z}, {0, size, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(Distance, ToItselfIsZero) {
  const SurfaceDistance d = distance(icosphere(3), icosphere(3));
  EXPECT_NEAR(d.hausdorff, 0, 1e-7);
  EXPECT_NEAR(d.to_reference.mean, 0, 1e-8);
}

TEST(Distance, BetweenParallelSquaresIsTheirGap) {
  const SurfaceDistance d = distance(square(0), square(0.25));
  for (const OneSidedDistance& side : {d.to_reference, d.from_reference}) {
    EXPECT_NEAR(side.max, 0.25, 1e-12);
    EXPECT_NEAR(side.mean, 0.25, 1e-12);
    EXPECT_NEAR(side.rms, 0.25, 1e-12);
  }
}

TEST(Distance, IsNotTheSameFromBothSides) {
  // From the unit square to the one twice as wide around it: 0. Back: 0 on a quarter of the area, beyond it the distance to the corner
  // region.
  const SurfaceDistance d = distance(square(0), square(0, 2));
  EXPECT_NEAR(d.to_reference.max, 0, 1e-12);
  EXPECT_NEAR(d.from_reference.max, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(d.hausdorff, d.from_reference.max);
  // Mean square: two strips of area 1 with mean square 1/3, one corner square with 2/3, over the area 4.
  EXPECT_NEAR(d.from_reference.rms, std::sqrt((1.0 / 3 + 1.0 / 3 + 2.0 / 3) / 4), 1e-3);
}

TEST(Distance, IsWeightedByAreaNotByTriangles) {
  TriangleMesh uneven = square(0);  // one half as one triangle, the other cut into 256
  TriangleMesh half = {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  uneven.triangles.pop_back();
  for (int round = 0; round < 4; ++round) {
    TriangleMesh finer;
    for (const auto& [a, b, c] : half.triangles) {
      const Vec3 p = half.points[a], q = half.points[b], r = half.points[c];
      finer = joined(finer, {{p, q, r, (p + q) / 2, (q + r) / 2, (r + p) / 2}, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}});
    }
    half = finer;
  }
  uneven = joined(uneven, half);
  const TriangleMesh tilted = {{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};  // z = x
  EXPECT_NEAR(distance(uneven, tilted).to_reference.mean, distance(square(0), tilted).to_reference.mean, 1e-4);
}

TEST(Distance, BetweenSpheresTendsToTheDifferenceOfTheirRadii) {
  const SurfaceDistance d = distance(icosphere(5, 2.0), icosphere(5, 2.5));
  EXPECT_NEAR(d.to_reference.mean, 0.5, 2e-3);
  EXPECT_NEAR(d.from_reference.mean, 0.5, 2e-3);
  EXPECT_LT(d.hausdorff, 0.5 + 2e-3);
}

TEST(Distance, IsReproducible) {
  const TriangleMesh a = noisy(icosphere(3), 0.05, 1);
  const SurfaceDistance first = distance(a, icosphere(3));
  const SurfaceDistance again = distance(a, icosphere(3));
  EXPECT_EQ(first.to_reference.rms, again.to_reference.rms);
  EXPECT_EQ(first.from_reference.mean, again.from_reference.mean);
}

TEST(Distance, DoesNotExistWithoutASurface) {
  TriangleMesh broken = cube();
  broken.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh flat = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  for (const TriangleMesh& mesh : {broken, flat, TriangleMesh{}}) {
    std::vector<std::string> notes;
    EXPECT_FALSE(surface_distance(mesh, cube(), notes).has_value());
    EXPECT_FALSE(surface_distance(cube(), mesh, notes).has_value());
    EXPECT_THAT(notes, ::testing::ElementsAre(::testing::HasSubstr("the mesh"), ::testing::HasSubstr("the reference")));
  }
}

}  // namespace
}  // namespace smopt::metrics
