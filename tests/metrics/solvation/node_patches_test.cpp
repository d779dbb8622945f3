#include "metrics/solvation/node_patches.h"

#include <gmock/gmock.h>

#include "smopt/mesh/orientation.h"
#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

std::vector<NodePatch> patches_of(const TriangleMesh& mesh) {
  return node_patches(mesh, build_stars(mesh));
}
std::vector<VertexId> degenerate_of(const TriangleMesh& mesh) {
  return degenerate_vertices(mesh, build_stars(mesh));
}

TEST(NodePatches, CoverTheSurface) {
  double area = 0;
  Vec3 vector = Vec3::Zero();
  for (const NodePatch& patch : patches_of(cube())) {
    area += patch.area;
    vector += patch.area_vector;
  }
  EXPECT_NEAR(area, 6, 1e-14);
  EXPECT_LT(vector.norm(), 1e-14);
}

TEST(NodePatches, NormalsPointOutwards) {
  const TriangleMesh mesh = icosphere(3, 2);
  const auto patches = patches_of(mesh);
  for (std::size_t v = 0; v < patches.size(); ++v) EXPECT_GT(patches[v].normal.dot(mesh.points[v]) / 2, 0.999);
}

TEST(NodePatches, KnowTheirLongestEdge) {
  for (const NodePatch& patch : patches_of(tetrahedron())) EXPECT_DOUBLE_EQ(patch.longest_edge, std::sqrt(8.0));
}

TEST(DegenerateVertices, AreNoneOnARegularMesh) {
  EXPECT_THAT(degenerate_of(icosphere(2)), ::testing::IsEmpty());
}

/// AFMPB's limit is on twice the area, 1e-8 Å².
TEST(DegenerateVertices, AreThoseWhoseTrianglesAreAllTooSmall) {
  EXPECT_THAT(degenerate_of(scaled(cube(), 0.9e-4)), ::testing::SizeIs(8));
  EXPECT_THAT(degenerate_of(scaled(cube(), 1.1e-4)), ::testing::IsEmpty());
}

/// Two triangles back to back: the normals at each corner cancel.
TEST(DegenerateVertices, AreThoseWhoseNormalsCancel) {
  const TriangleMesh sheet = {{{0, 0, 0}, {1, 0, 0}, {0.3, 0.7, 0.2}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(degenerate_of(sheet), ::testing::ElementsAre(0, 1, 2));
  for (const NodePatch& patch : patches_of(sheet)) EXPECT_FALSE(patch.has_normal());
}

TEST(DegenerateVertices, DoNotCountPointsInNoTriangle) {
  TriangleMesh mesh = cube();
  mesh.points.emplace_back(5, 5, 5);
  EXPECT_THAT(degenerate_of(mesh), ::testing::IsEmpty());
}

}  // namespace
}  // namespace smopt::metrics
