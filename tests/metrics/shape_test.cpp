#include "metrics/shape.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "metrics/extent.h"
#include "metrics/valence.h"
#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> ignored;

Shape shape_of(const TriangleMesh& mesh) {
  return measure_shape(mesh, ignored);
}
Extent extent_of(const TriangleMesh& mesh) {
  return measure_extent(mesh, measure_topology(mesh, ignored), ignored);
}

TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{a, b, c}, {{0, 1, 2}}};
}

std::size_t total(const Histogram& h) {
  return std::accumulate(h.counts.begin(), h.counts.end(), std::size_t{0});
}

TEST(Histogram, PutsValuesOnAnEdgeIntoTheUpperBin) {
  Histogram h(0, 1, 50);
  for (int i = 0; i < 50; ++i) h.add(h.edges[static_cast<std::size_t>(i)]);
  EXPECT_THAT(h.counts, ::testing::Each(1U));
  h.add(1.0);
  EXPECT_EQ(h.counts.back(), 2U) << "the last bin holds its upper edge";
  EXPECT_DOUBLE_EQ(h.edges[5], 0.1);
}

TEST(Shape, OfEquilateralTriangles) {
  const Shape s = shape_of(tetrahedron());
  EXPECT_DOUBLE_EQ(*s.edge_ratio.min, 1);
  EXPECT_DOUBLE_EQ(*s.edge_ratio.mean, 1);
  EXPECT_NEAR(*s.angle.min, 60, 1e-12);
  EXPECT_NEAR(*s.angle.max, 60, 1e-12);
  EXPECT_EQ(*s.edge_ratio.share_below_01, 0);
  EXPECT_EQ(s.edge_ratio.histogram.counts.back(), 4U);
  EXPECT_EQ(total(s.angle.histogram), 12U);
}

TEST(Shape, OfACube) {
  const Shape s = shape_of(cube());
  EXPECT_NEAR(*s.edge_ratio.median, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(*s.angle.mean_min, 45, 1e-12);
  EXPECT_NEAR(*s.angle.max, 90, 1e-12);
  EXPECT_EQ(*s.angle.smallest_below_30, 0);
}

TEST(Shape, OfAThreeFourFiveTriangle) {
  const Shape s = shape_of(triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0}));
  EXPECT_DOUBLE_EQ(*s.edge_ratio.min, 0.6);
  EXPECT_NEAR(*s.angle.min, std::atan2(3, 4) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(*s.angle.max, 90, 1e-12);
  EXPECT_EQ(s.angle.histogram.counts[18], 1U) << "36.87° is in [36°, 38°)";
  EXPECT_EQ(s.angle.histogram.counts[26], 1U) << "53.13° is in [52°, 54°)";
}

TEST(Shape, SharesCountTrianglesOnceAndLimitsAreStrict) {
  TriangleMesh mesh = triangle({0, 0, 0}, {10, 0, 0}, {10, 0.5, 0});  // smallest angle 2.86°, ratio 0.05
  mesh = joined(mesh, triangle({0, 0, 0}, {2, 0, 0}, {1, 0.2, 0}));   // cap: 11.3°, 157.4°
  mesh = joined(mesh, joined(tetrahedron(), triangle({0, 0, 0}, {10, 0, 0}, {0, 1, 0})));
  const Shape s = shape_of(mesh);
  const double n = 7;
  EXPECT_DOUBLE_EQ(*s.edge_ratio.share_below_01, 2 / n) << "0.05 and 0.0995";
  EXPECT_DOUBLE_EQ(*s.angle.smallest_below_5, 1 / n);
  EXPECT_DOUBLE_EQ(*s.angle.smallest_below_10, 2 / n);
  EXPECT_DOUBLE_EQ(*s.angle.smallest_below_20, 3 / n);
  EXPECT_DOUBLE_EQ(*s.angle.largest_above_120, 1 / n);
  EXPECT_DOUBLE_EQ(*s.angle.largest_above_150, 1 / n);
}

TEST(Shape, ANeedleKeepsItsDigits) {
  const double thin = 1e-9;
  const Shape s = shape_of(triangle({0, 0, 0}, {1, 0, 0}, {1, thin, 0}));
  EXPECT_NEAR(*s.angle.min, thin * 180 / M_PI, 1e-9 * thin);
}

TEST(Shape, ADegenerateTriangleHasRatioAndAngleZero) {
  EXPECT_EQ(*shape_of(triangle({1, 2, 3}, {1, 2, 3}, {4, 5, 6})).edge_ratio.min, 0);
  EXPECT_EQ(*shape_of(triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3})).edge_ratio.min, 0);
  const Shape flat = shape_of(triangle({0, 0, 0}, {1, 0, 0}, {3, 0, 0}));
  EXPECT_EQ(*flat.angle.min, 0);
  EXPECT_EQ(*flat.angle.max, 180);
}

TEST(Shape, LeavesOutTrianglesThatAreNotFiniteAndSaysSo) {
  TriangleMesh mesh = joined(tetrahedron(), cube());
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();  // in three of the tetrahedron's triangles
  std::vector<std::string> notes;
  const Shape s = measure_shape(mesh, notes);
  EXPECT_EQ(total(s.edge_ratio.histogram), 13U);
  EXPECT_THAT(notes, ::testing::ElementsAre(::testing::HasSubstr(" 3 triangles")));
}

TEST(Shape, OfAnEmptyMeshHasNoNumbersButItsBins) {
  const Shape s = shape_of({});
  EXPECT_FALSE(s.edge_ratio.min || s.edge_ratio.median || s.angle.max || s.angle.smallest_below_10);
  EXPECT_EQ(s.edge_ratio.histogram.edges.size(), 51U);
  EXPECT_EQ(s.angle.histogram.edges.size(), 91U);
}

TEST(Shape, DoesNotChangeWithMotionAndScale) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 3);
  const Shape a = shape_of(mesh);
  const Shape b = shape_of(scaled(rotated(translated(mesh, {1, 2, 3}), {1, 1, 2}, 0.7), 13));
  EXPECT_NEAR(*a.angle.min, *b.angle.min, 1e-10);
  EXPECT_NEAR(*a.edge_ratio.mean, *b.edge_ratio.mean, 1e-12);
}

TEST(Extent, OfTheCubeAndTheTetrahedron) {
  EXPECT_DOUBLE_EQ(*extent_of(cube()).area, 6);
  EXPECT_DOUBLE_EQ(*extent_of(cube()).volume, 1);
  EXPECT_NEAR(*extent_of(tetrahedron()).area, std::sqrt(3.0) * 8, 1e-14);
  EXPECT_NEAR(*extent_of(tetrahedron()).volume, 8.0 / 3, 1e-15);
}

TEST(Extent, OfATorusTendsToTheFormula) {
  const Extent e = extent_of(torus(3, 1, 400, 300));
  EXPECT_NEAR(*e.area, 4 * M_PI * M_PI * 3, 0.01);
  EXPECT_NEAR(*e.volume, 2 * M_PI * M_PI * 3, 0.02);
}

TEST(Extent, VolumeIsSignedAndSubtractsCavities) {
  EXPECT_DOUBLE_EQ(*extent_of(reversed(cube())).volume, -1);
  const TriangleMesh hollow = joined(cube(), reversed(translated(scaled(cube(), 0.5), {0.25, 0.25, 0.25})));
  EXPECT_DOUBLE_EQ(*extent_of(hollow).volume, 1 - 0.125);
}

TEST(Extent, KeepsItsDigitsFarFromTheOrigin) {
  EXPECT_NEAR(*extent_of(translated(cube(), {1e6, -1e6, 1e6})).volume, 1, 1e-9);
}

TEST(Extent, HasNoVolumeWhereNothingIsEnclosed) {
  TriangleMesh open = cube();
  open.triangles.pop_back();
  TriangleMesh flipped = cube();
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  for (const TriangleMesh& mesh : {open, flipped, TriangleMesh{}}) {
    std::vector<std::string> notes;
    EXPECT_FALSE(measure_extent(mesh, measure_topology(mesh, ignored), notes).volume.has_value());
    EXPECT_THAT(notes, Not(IsEmpty()));
  }
  EXPECT_DOUBLE_EQ(*extent_of(open).area, 5.5);
}

TEST(Valence, OfKnownMeshes) {
  const Valence sphere = measure_valence(icosphere(2), ignored);
  EXPECT_EQ(sphere.min, 5U);
  EXPECT_EQ(sphere.max, 6U);
  EXPECT_DOUBLE_EQ(*sphere.share_6, 150.0 / 162);
  EXPECT_DOUBLE_EQ(*sphere.share_5_6_7, 1);
  EXPECT_DOUBLE_EQ(*measure_valence(torus(3, 1, 12, 8), ignored).share_6, 1);
  EXPECT_EQ(measure_valence(tetrahedron(), ignored).max, 3U);
}

TEST(Valence, LeavesOutIsolatedVerticesAndDoesNotExistWithoutEdges) {
  TriangleMesh mesh = torus(3, 1, 12, 8);
  mesh.points.emplace_back(0, 0, 0);
  EXPECT_EQ(measure_valence(mesh, ignored).min, 6U);
  std::vector<std::string> notes;
  EXPECT_FALSE(measure_valence({}, notes).min.has_value());
  EXPECT_THAT(notes, Not(IsEmpty()));
}

}  // namespace
}  // namespace smopt::metrics
