#include "baselines/vertex_neighbours.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

TEST(VertexNeighbours, AreTheEndsOfTheEdgesEachOnce) {
  const TriangleMesh mesh = joined(icosphere(2), torus(2, 0.7, 16, 8));
  std::vector<std::set<VertexId>> expected(mesh.points.size());
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId a : t) {
      for (const VertexId b : t) {
        if (a != b) expected[a].insert(b);
      }
    }
  }
  const VertexNeighbours neighbours = build_neighbours(mesh);
  ASSERT_EQ(neighbours.vertex_count(), mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_EQ(neighbours[v].size(), expected[v].size());
    EXPECT_EQ(std::set<VertexId>(neighbours[v].begin(), neighbours[v].end()), expected[v]);
  }
}

TEST(VertexNeighbours, TakeAnyTriangles) {
  // An open fan of two triangles that are turned against each other, a triangle twice, one with a repeated corner, an isolated vertex.
  const TriangleMesh mesh{std::vector<Vec3>(6, Vec3::Zero()), {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 1, 2}}, {{4, 0, 4}}}};
  const VertexNeighbours neighbours = build_neighbours(mesh);
  EXPECT_THAT(neighbours[0], UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_THAT(neighbours[1], UnorderedElementsAre(0, 2, 3));
  EXPECT_THAT(neighbours[4], UnorderedElementsAre(0));
  EXPECT_THAT(neighbours[5], IsEmpty());
}

}  // namespace
}  // namespace smopt::baselines
