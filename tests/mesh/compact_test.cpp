#include "smopt/mesh/compact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(KeepTriangles, KeepsTheFlaggedInTheirOrderAndEveryPoint) {
  TriangleMesh mesh{std::vector<Vec3>(5, Vec3::Ones()), {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 3, 4}}};
  keep_triangles(mesh, {1, 0, 0, 1});
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 3, 4}));
  EXPECT_EQ(mesh.points.size(), 5U);
  keep_triangles(mesh, {0, 0});
  EXPECT_THAT(mesh.triangles, IsEmpty());
}

TEST(RemoveIsolatedVertices, KeepsOrderAndPlaces) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, {{4, 1, 3}, {3, 1, 4}}};
  EXPECT_EQ(remove_isolated_vertices(mesh), 3U);
  EXPECT_THAT(mesh.points, ElementsAre(Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 0, 1}, Triangle{1, 0, 2}));
}

TEST(RemoveIsolatedVertices, LeavesAMeshWithoutThemAlone) {
  TriangleMesh mesh = icosphere(2);
  EXPECT_EQ(remove_isolated_vertices(mesh), 0U);
  EXPECT_EQ(mesh.points, icosphere(2).points);
  EXPECT_EQ(mesh.triangles, icosphere(2).triangles);
}

TEST(RemoveIsolatedVertices, TakesEverythingFromAMeshWithoutTriangles) {
  TriangleMesh mesh{std::vector<Vec3>(3, Vec3::Zero()), {}};
  EXPECT_EQ(remove_isolated_vertices(mesh), 3U);
  EXPECT_THAT(mesh.points, IsEmpty());
}

TEST(Compact, TakingOneComponentOutLeavesTheOtherAsItWas) {
  const TriangleMesh sphere = icosphere(2, 1, {9, 0, 0});
  TriangleMesh mesh = joined(cube(), sphere);
  std::vector<char> is_kept(mesh.triangle_count(), 1);
  std::fill_n(is_kept.begin(), 12, char{0});
  keep_triangles(mesh, is_kept);
  EXPECT_EQ(remove_isolated_vertices(mesh), 8U);
  EXPECT_EQ(mesh.points, sphere.points);
  EXPECT_EQ(mesh.triangles, sphere.triangles);
  EXPECT_THAT(mesh, IsClosedManifold());
}

}  // namespace
}  // namespace smopt
