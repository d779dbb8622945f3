#include "experiments/page/shown_part.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using testing::icosphere;

Vec3 centroid(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
}

TEST(ShownPart, ABallHoldsAsManyTrianglesAsAskedFor) {
  const TriangleMesh mesh = testing::noisy(icosphere(3), 0.01, 1);  // no two centroids equally far
  const Ball ball = ball_around(mesh, mesh.points[5], 100);
  EXPECT_FALSE(ball.is_whole());
  EXPECT_EQ(shown_part(mesh, ball).faces.size(), 100U);
}

TEST(ShownPart, ASmallMeshIsShownWhole) {
  const TriangleMesh mesh = icosphere(2);
  const Ball ball = ball_around(mesh, mesh.points[0], mesh.triangle_count());
  EXPECT_TRUE(ball.is_whole());
  const ShownPart part = shown_part(mesh, ball);
  EXPECT_EQ(part.mesh.points, mesh.points);
  EXPECT_EQ(part.mesh.triangles, mesh.triangles);
  EXPECT_EQ(part.undrawable, 0U);
}

TEST(ShownPart, HoldsTheTrianglesOfTheBallAndNoOthers) {
  const TriangleMesh mesh = icosphere(3);
  const Ball ball{mesh.points[17], 0.4};
  const ShownPart part = shown_part(mesh, ball);
  std::vector<FaceId> inside;
  for (FaceId face = 0; face < mesh.triangle_count(); ++face)
    if ((centroid(mesh, mesh.triangles[face]) - ball.centre).norm() <= ball.radius) inside.push_back(face);
  ASSERT_FALSE(inside.empty());
  EXPECT_EQ(part.faces, inside);
}

TEST(ShownPart, KeepsTheCornersOfItsTrianglesAndSharesThemAsBefore) {
  const TriangleMesh mesh = icosphere(3);
  const ShownPart part = shown_part(mesh, {mesh.points[17], 0.4});
  std::vector<VertexId> used;
  for (std::size_t i = 0; i < part.faces.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const VertexId whole = mesh.triangles[part.faces[i]][corner];
      EXPECT_EQ(part.mesh.points[part.mesh.triangles[i][corner]], mesh.points[whole]);
      used.push_back(whole);
    }
  }
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  EXPECT_EQ(part.mesh.vertex_count(), used.size());
}

TEST(ShownPart, LeavesOutAndCountsWhatCannotBeDrawn) {
  for (const double coordinate : {std::numeric_limits<double>::quiet_NaN(), 1e30, -std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = icosphere(1);
    mesh.points[3].y() = coordinate;
    const auto around = static_cast<std::size_t>(
        std::ranges::count_if(mesh.triangles, [](const Triangle& t) { return std::ranges::count(t, VertexId{3}) > 0; }));
    const ShownPart part = shown_part(mesh, {});
    EXPECT_EQ(part.undrawable, around);
    EXPECT_EQ(part.faces.size(), mesh.triangle_count() - around);
    for (const Vec3& point : part.mesh.points) EXPECT_TRUE(point.allFinite());
  }
}

TEST(ShownPart, OfAnEmptyMeshIsEmpty) {
  EXPECT_TRUE(ball_around({}, Vec3::Zero(), 10).is_whole());
  EXPECT_TRUE(shown_part({}, {}).faces.empty());
}

}  // namespace
}  // namespace smopt::experiments
