#include "experiments/figures/pair_view.h"

#include <gmock/gmock.h>

#include "metrics/intersections.h"

namespace smopt::experiments {
namespace {

using Pair = std::pair<FaceId, FaceId>;
using ::testing::ElementsAre;

/// Two triangles that cross in the middle of each: one in the plane z = 0, one in the plane x = 0; at `centre`, of about `size`.
void add_cross(TriangleMesh& mesh, const Vec3& centre, double size) {
  const auto first = static_cast<VertexId>(mesh.points.size());
  for (const Vec3& p : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1.5, 0), Vec3(0, -0.8, -1), Vec3(0, -0.8, 1), Vec3(0, 1, 0)})
    mesh.points.emplace_back(centre + size * p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first + 3, first + 4, first + 5});
}

std::vector<Pair> pairs_of(const TriangleMesh& mesh) {
  return metrics::find_intersections(mesh).pairs;
}

TEST(CrossingOf, IsTheSegmentInBothTriangles) {
  const auto ends = crossing_of({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1.5, 0)}, {Vec3(0, -0.8, -1), Vec3(0, -0.8, 1), Vec3(0, 1, 0)});
  ASSERT_TRUE(ends);
  EXPECT_NEAR(((*ends)[1] - (*ends)[0]).norm(), 1.8, 1e-12);
  for (const Vec3& end : *ends) EXPECT_NEAR(end.cwiseAbs()[0] + end.cwiseAbs()[2], 0, 1e-12) << "on the axis that the planes share";
}

TEST(CrossingOf, IsNothingForTrianglesThatTouchInAPointLieInOnePlaneOrMiss) {
  const std::array<Vec3, 3> floor{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_FALSE(crossing_of(floor, {Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1), Vec3(0.4, 0.2, 1)})) << "a corner on it";
  EXPECT_FALSE(crossing_of(floor, {Vec3(0.1, 0.1, 0), Vec3(1.1, 0.1, 0), Vec3(0.1, 1.1, 0)})) << "in its plane";
  EXPECT_FALSE(crossing_of(floor, {Vec3(5, 5, -1), Vec3(5, 5, 1), Vec3(6, 5, 0)}));
}

TEST(PairView, TakesThePairThatShowsMost) {
  TriangleMesh mesh;
  add_cross(mesh, {0, 0, 0}, 1);
  add_cross(mesh, {10, 0, 0}, 2);
  add_cross(mesh, {0, 10, 0}, 0.5);
  const auto view = find_pair_view(mesh, pairs_of(mesh));
  ASSERT_TRUE(view);
  EXPECT_EQ(view->pair, Pair(2, 3));
  EXPECT_LT((view->piece.centre - Vec3(10, 0.2, 0)).norm(), 1e-9);
}

TEST(PairView, LooksAtBothTrianglesAndNotAlongTheirCrossing) {
  TriangleMesh mesh;
  add_cross(mesh, {0, 0, 0}, 1);
  const auto view = find_pair_view(mesh, pairs_of(mesh));
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->towards.norm(), 1, 1e-12);
  EXPECT_GT(std::abs(view->towards[2]), 0.3) << "the triangle in the plane z = 0";
  EXPECT_GT(std::abs(view->towards[0]), 0.3) << "that in the plane x = 0";
  EXPECT_LT(std::abs(view->towards[1]), 0.7) << "the crossing is along y";
}

TEST(PairView, LooksPastWhatIsInFront) {
  TriangleMesh open;
  add_cross(open, {0, 0, 0}, 1);
  const Vec3 before = find_pair_view(open, pairs_of(open))->towards;
  TriangleMesh covered = open;
  // A large triangle across that line of sight.
  const Vec3 u = before.unitOrthogonal(), v = before.cross(u);
  for (const Vec3& p : {Vec3(1.8 * before - 2 * u - 2 * v), Vec3(1.8 * before + 2 * u - 2 * v), Vec3(1.8 * before + 3 * v)})
    covered.points.push_back(p);
  covered.triangles.push_back({6, 7, 8});
  const std::vector<Pair> pair{{0, 1}};
  const auto view = find_pair_view(covered, pair);
  ASSERT_TRUE(view);
  EXPECT_LT(view->towards.dot(before), 0.7);
}

TEST(PairView, IsNothingWhereAllPairsTouch) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0}, {0.2, 0.2, 1}, {0.4, 0.2, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  ASSERT_THAT(pairs_of(mesh), ElementsAre(Pair(0, 1)));
  EXPECT_FALSE(find_pair_view(mesh, pairs_of(mesh)));
  EXPECT_FALSE(find_pair_view(mesh, {}));
}

TEST(FacesIn, HaveACornerInTheSphere) {
  TriangleMesh mesh;
  add_cross(mesh, {0, 0, 0}, 1);
  add_cross(mesh, {10, 0, 0}, 1);
  EXPECT_THAT(faces_in(mesh, {{10, 1.5, 0}, 0.1}), ElementsAre(2U));
}

}  // namespace
}  // namespace smopt::experiments
