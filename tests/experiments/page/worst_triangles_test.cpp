#include "experiments/page/worst_triangles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using testing::icosphere;
using testing::noisy;

std::vector<FaceId> all_faces(const TriangleMesh& mesh) {
  std::vector<FaceId> faces(mesh.triangle_count());
  std::iota(faces.begin(), faces.end(), FaceId{0});
  return faces;
}

double value_of(const TriangleMesh& mesh, TriangleMeasure measure, FaceId face) {
  const Triangle& t = mesh.triangles[face];
  return measure_triangle(measure, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

bool is_worse(TriangleMeasure measure, double a, double b) {
  return measure == TriangleMeasure::largest_angle ? a > b : a < b;
}

TEST(WorstTriangles, HaveTheAnglesAndTheRatioOfTheRightTriangleOfThreeFourFive) {
  const Vec3 a(0, 0, 0), b(3, 0, 0), c(0, 4, 0);
  EXPECT_NEAR(measure_triangle(TriangleMeasure::smallest_angle, a, b, c), 36.86989764584402, 1e-12);
  EXPECT_NEAR(measure_triangle(TriangleMeasure::largest_angle, a, b, c), 90, 1e-12);
  EXPECT_NEAR(measure_triangle(TriangleMeasure::edge_ratio, a, b, c), 0.6, 1e-15);
}

TEST(WorstTriangles, TellTheAngleOfANeedleToTheLastDigits) {
  const double thinness = 1e-9;
  const double angle = measure_triangle(TriangleMeasure::smallest_angle, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, thinness, 0));
  EXPECT_NEAR(angle / (thinness * 180 / std::numbers::pi), 1, 1e-12);
}

TEST(WorstTriangles, AreThoseThatABruteForceFindsWithTheirRanks) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.03, 7);
  const std::vector<FaceId> faces = all_faces(mesh);
  for (const TriangleMeasure measure : kTriangleMeasures) {
    const std::vector<RankedTriangle> worst = worst_triangles(mesh, measure, faces, 20);
    ASSERT_EQ(worst.size(), 20U);
    for (std::size_t i = 0; i < worst.size(); ++i) {
      EXPECT_EQ(worst[i].rank, i + 1);
      EXPECT_EQ(worst[i].value, value_of(mesh, measure, worst[i].face)) << to_string(measure);
      const auto worse =
          std::ranges::count_if(faces, [&](FaceId face) { return is_worse(measure, value_of(mesh, measure, face), worst[i].value); });
      EXPECT_EQ(static_cast<std::size_t>(worse), i) << to_string(measure);
    }
  }
}

TEST(WorstTriangles, OfSomeCandidatesKeepTheirRanksInTheWholeMesh) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.05, 3);
  const std::vector<RankedTriangle> all = worst_triangles(mesh, TriangleMeasure::edge_ratio, all_faces(mesh), mesh.triangle_count());
  const std::vector<FaceId> candidates = {all[4].face, all[9].face, all[30].face};
  const std::vector<RankedTriangle> worst = worst_triangles(mesh, TriangleMeasure::edge_ratio, candidates, 2);
  ASSERT_EQ(worst.size(), 2U);
  EXPECT_EQ(worst[0].face, all[4].face);
  EXPECT_EQ(worst[0].rank, 5U);
  EXPECT_EQ(worst[1].rank, 10U);
}

TEST(WorstTriangles, PassOverCornersThatAreNotFinite) {
  TriangleMesh mesh = icosphere(1);
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  const auto around = std::ranges::count_if(mesh.triangles, [](const Triangle& t) { return std::ranges::count(t, VertexId{0}) > 0; });
  ASSERT_GT(around, 0);
  const std::vector<RankedTriangle> worst = worst_triangles(mesh, TriangleMeasure::smallest_angle, all_faces(mesh), mesh.triangle_count());
  EXPECT_EQ(worst.size(), mesh.triangle_count() - static_cast<std::size_t>(around));
  for (const RankedTriangle& triangle : worst) EXPECT_TRUE(std::isfinite(triangle.value));
}

TEST(WorstTriangles, OfAnEmptyMeshAreNone) {
  EXPECT_TRUE(worst_triangles({}, TriangleMeasure::largest_angle, {}, 5).empty());
}

}  // namespace
}  // namespace smopt::experiments
