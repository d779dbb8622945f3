#include "smopt/improve/remesh/two_sided_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "smopt/error.h"
#include "tests/improve/remesh/flat_lattice.h"
#include "tests/improve/remesh/sampled_distance.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt {
namespace {

using namespace testing;

constexpr double kTolerance = 1e-4;

/// The bounds hold a value and are as close as they were asked to be.
void expect_encloses(const FarthestPoint& found, double value, double tolerance = kTolerance) {
  EXPECT_LE(found.lower, value * (1 + 1e-12));
  EXPECT_GE(found.upper, value * (1 - 1e-12));
  EXPECT_LE(found.upper - found.lower, tolerance);
}

/// Against dense samples: never above the upper bound, and the lower bound is where it is said to be.
void expect_agrees_with_samples(const FarthestPoint& found, const TriangleMesh& from, const TriangleMesh& to, const char* what) {
  const double sampled = sampled_distance(from, to, 6);
  EXPECT_LE(sampled, found.upper) << what;
  EXPECT_LE(found.upper - found.lower, kTolerance) << what;
  EXPECT_NEAR(distance_from_surface(found.point, to), found.lower, 1e-9) << what;
  EXPECT_NEAR(distance_from_surface(found.point, from), 0, 1e-9) << what;
}

TEST(TwoSidedDistance, OfACubeInACubeIsTheGapInwardAndTheDiagonalOutward) {
  constexpr double kGap = 0.1;
  const TriangleMesh inner = cube(), outer = translated(scaled(cube(), 1 + 2 * kGap), Vec3::Constant(-kGap));
  const TwoSidedDistance distance = two_sided_distance(inner, outer, kTolerance);
  expect_encloses(distance.from_a, kGap);
  expect_encloses(distance.from_b, kGap * std::numbers::sqrt3);
  EXPECT_NEAR((distance.from_b.point - Vec3::Constant(0.5)).cwiseAbs().minCoeff(), 0.5 + kGap, 1e-12) << "a corner";
  EXPECT_EQ(distance.upper(), distance.from_b.upper);
  EXPECT_EQ(distance.lower(), distance.from_b.lower);
}

TEST(TwoSidedDistance, OfTheSamePlaneInOtherTrianglesIsZero) {
  const TriangleMesh coarse = flat_lattice(1);
  for (const VertexId n : {2U, 3U, 7U}) {
    const TriangleMesh fine = scaled(flat_lattice(n), 1.0 / n);
    const Vec3 axis(1, 2, 3);
    const TwoSidedDistance distance = two_sided_distance(rotated(coarse, axis, 1), rotated(fine, axis, 1), 1e-12);
    EXPECT_EQ(distance.lower(), 0) << n;
    EXPECT_LE(distance.upper(), 1e-12) << n;
  }
}

TEST(TwoSidedDistance, OfARefinedSphereIsAtTheMiddleOfItsLargestTriangles) {
  const TriangleMesh coarse = icosphere(0), fine = icosphere(4);
  const TwoSidedDistance distance = two_sided_distance(coarse, fine, kTolerance);
  // The icosahedron's inscribed sphere, by its dihedral angle; the fine mesh is within 1e-3 of the sphere.
  const double inscribed = std::sqrt((5 + 2 * std::sqrt(5.0)) / 15);
  EXPECT_NEAR(distance.from_a.upper, 1 - inscribed, 2e-3);
  EXPECT_NEAR(distance.from_b.upper, 1 - inscribed, 2e-3);
  expect_agrees_with_samples(distance.from_a, coarse, fine, "coarse");
}

TEST(TwoSidedDistance, ASpikeIsSeenInFullFromItsOwnSideOnly) {
  const TriangleMesh smooth = icosphere(2);
  TriangleMesh spiky = smooth;
  spiky.points[7] *= 1.5;
  const TwoSidedDistance distance = two_sided_distance(smooth, spiky, kTolerance);
  expect_encloses(distance.from_b, 0.5);
  EXPECT_EQ(distance.from_b.point, spiky.points[7]);
  EXPECT_LT(distance.from_a.upper, 0.3);
  EXPECT_GT(distance.from_a.lower, 0);
}

TEST(TwoSidedDistance, AgreesWithDenseSamplesOnRandomSurfaces) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const TriangleMesh a = noisy(icosphere(2), 0.05 * seed, seed), b = rotated(noisy(icosphere(1), 0.2, seed + 100), Vec3(1, 1, 0), seed);
    const TwoSidedDistance distance = two_sided_distance(a, b, kTolerance);
    expect_agrees_with_samples(distance.from_a, a, b, ("a, seed " + std::to_string(seed)).c_str());
    expect_agrees_with_samples(distance.from_b, b, a, ("b, seed " + std::to_string(seed)).c_str());
    EXPECT_GE(distance.from_a.lower, sampled_distance(a, b, 12) - kTolerance) << "seed " << seed;
  }
}

TEST(TwoSidedDistance, OfSurfacesFarApartIsThatOfTheirFarEnds) {
  const TriangleMesh a = scaled(icosphere(3), 1), b = translated(scaled(cube(), 0.1), Vec3(10, 0, 0));
  const TwoSidedDistance distance = two_sided_distance(a, b, kTolerance);
  expect_agrees_with_samples(distance.from_a, a, b, "a");
  expect_agrees_with_samples(distance.from_b, b, a, "b");
  EXPECT_NEAR(distance.from_a.upper, 11, 1e-2);
}

TEST(TwoSidedDistance, SwapsWithItsArguments) {
  const TriangleMesh a = noisy(icosphere(2), 0.1, 1), b = noisy(icosphere(2), 0.1, 2);
  const TwoSidedDistance one = two_sided_distance(a, b, kTolerance), other = two_sided_distance(b, a, kTolerance);
  EXPECT_EQ(one.from_a.upper, other.from_b.upper);
  EXPECT_EQ(one.from_b.lower, other.from_a.lower);
}

TEST(TwoSidedDistance, StaysThroughMotionAndRelabellingAndGrowsWithScale) {
  const TriangleMesh a = noisy(icosphere(2), 0.1, 3), b = noisy(icosphere(2), 0.1, 4);
  const TwoSidedDistance before = two_sided_distance(a, b, kTolerance);
  const auto expect_overlaps = [&](const TwoSidedDistance& d, double factor, const char* what) {
    EXPECT_LE(d.lower(), factor * before.upper() + 1e-9) << what;
    EXPECT_GE(d.upper(), factor * before.lower() - 1e-9) << what;
    EXPECT_LE(d.upper() - d.lower(), factor * kTolerance) << what;
  };
  const auto moved = [](const TriangleMesh& mesh) { return translated(rotated(mesh, Vec3(1, -2, 3), 2), Vec3(3, 4, 5)); };
  expect_overlaps(two_sided_distance(moved(a), moved(b), kTolerance), 1, "moved");
  expect_overlaps(two_sided_distance(relabelled(a, 1), relabelled(b, 2), kTolerance), 1, "relabelled");
  expect_overlaps(two_sided_distance(scaled(a, 1e3), scaled(b, 1e3), 1e3 * kTolerance), 1e3, "scaled");
  const Vec3 far(1e6, -1e6, 1e6);
  expect_overlaps(two_sided_distance(translated(a, far), translated(b, far), kTolerance), 1, "far from the origin");
}

TEST(TwoSidedDistance, TakesDegenerateTrianglesForTheSegmentsAndPointsThatTheyAre) {
  const TriangleMesh plane{{{-10, -10, 0}, {10, -10, 0}, {0, 20, 0}}, {{0, 1, 2}}};
  const TriangleMesh segment{{{0, 0, 1}, {1, 0, 1}, {3, 0, 2}, {2, 0, 1.5}}, {{1, 2, 3}}};
  const TriangleMesh point{{{1, 1, 4}}, {{0, 0, 0}}};
  const TriangleMesh needle{{{0, 0, 3}, {3, 1e-9, 3}, {5, 0, 3}}, {{0, 1, 2}}};
  expect_encloses(two_sided_distance(segment, plane, kTolerance).from_a, 2);
  expect_encloses(two_sided_distance(point, plane, kTolerance).from_a, 4);
  expect_encloses(two_sided_distance(needle, plane, kTolerance).from_a, 3);
  expect_encloses(two_sided_distance(point, segment, kTolerance).from_a, std::sqrt(1.44 + 1 + 5.76));
  expect_encloses(two_sided_distance(joined(plane, needle), plane, kTolerance).from_a, 3);
  expect_encloses(two_sided_distance(plane, joined(plane, needle), kTolerance).from_a, 0);
}

/// Along the curve that is equally far from two triangles, the number of pieces grows as the tolerance shrinks: they run out here.
TEST(TwoSidedDistance, StaysCloseWhereTheToleranceIsOutOfReach) {
  const TriangleMesh bend{{{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {-1, 0, 1}, {-1, 1, 1}},
                          {{0, 1, 2}, {1, 3, 2}, {0, 1, 4}, {1, 5, 4}}};
  const TriangleMesh lid{{{-0.7, 0.4, 1}, {0.9, 0.4, 1}, {-0.7, 0.6, 1}, {0.9, 0.6, 1}}, {{0, 1, 2}, {1, 3, 2}}};
  const FarthestPoint coarse = two_sided_distance(lid, bend, 1e-3).from_a, fine = two_sided_distance(lid, bend, 1e-12).from_a;
  EXPECT_GT(fine.upper - fine.lower, 1e-12) << "the limit was not reached: nothing is tested";
  EXPECT_LE(fine.upper - fine.lower, 1e-3);
  EXPECT_LE(fine.lower, coarse.upper);
  EXPECT_GE(fine.upper, coarse.lower);
}

TEST(TwoSidedDistance, OfEmptySurfacesIsZeroFromThemAndInfiniteToThem) {
  const TriangleMesh none, some = cube();
  EXPECT_EQ(two_sided_distance(none, none, kTolerance).upper(), 0);
  const TwoSidedDistance distance = two_sided_distance(none, some, kTolerance);
  EXPECT_EQ(distance.from_a.upper, 0);
  EXPECT_EQ(distance.from_b.lower, HUGE_VAL);
  EXPECT_EQ(distance.from_b.upper, HUGE_VAL);
}

TEST(TwoSidedDistance, DoesNotCountPointsWithoutATriangle) {
  TriangleMesh mesh = cube();
  mesh.points.emplace_back(100, 0, 0);
  mesh.points.emplace_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_LE(two_sided_distance(mesh, cube(), kTolerance).upper(), kTolerance);
}

TEST(TwoSidedDistance, RefusesWhatIsNotFinite) {
  TriangleMesh mesh = cube();
  mesh.points[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(two_sided_distance(mesh, cube(), kTolerance), InvalidMesh);
  EXPECT_THROW(two_sided_distance(cube(), mesh, kTolerance), InvalidMesh);
  for (const double tolerance : {0.0, -1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(two_sided_distance(cube(), cube(), tolerance), InvalidOption) << tolerance;
}

TEST(TwoSidedDistance, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh a = noisy(icosphere(4), 0.02, 5), b = relabelled(rotated(noisy(icosphere(4), 0.02, 6), Vec3(1, 2, 3), 1), 7);
  expect_same_for_any_threads([&] {
    const TwoSidedDistance d = two_sided_distance(a, b, 1e-3);
    return std::tuple(d.from_a.lower, d.from_a.upper, d.from_a.point, d.from_b.lower, d.from_b.upper, d.from_b.point);
  });
}

}  // namespace
}  // namespace smopt
