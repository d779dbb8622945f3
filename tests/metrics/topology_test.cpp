#include "metrics/topology.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::IsEmpty;
using ::testing::Not;

Topology topology_of(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  return measure_topology(mesh, notes);
}

TriangleMesh without_last_triangle(TriangleMesh mesh) {
  mesh.triangles.pop_back();
  return mesh;
}

TEST(Topology, CountsASphereByEulersFormula) {
  const Topology t = topology_of(icosphere(2));
  EXPECT_EQ(t.vertices, 162U);
  EXPECT_EQ(t.triangles, 320U);
  EXPECT_EQ(t.edges, 480U);
  EXPECT_EQ(t.components, 1U);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.genus, 0);
  EXPECT_TRUE(t.closed && t.edge_manifold && t.vertex_manifold && t.oriented);
}

TEST(Topology, ATorusHasGenusOne) {
  const Topology t = topology_of(torus(3, 1, 12, 8));
  EXPECT_EQ(t.euler_characteristic, 0);
  EXPECT_EQ(t.genus, 1);
}

TEST(Topology, GenusIsSummedOverComponents) {
  const Topology t = topology_of(joined(torus(3, 1, 12, 8), joined(torus(9, 1, 12, 8), cube())));
  EXPECT_EQ(t.components, 3U);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.genus, 2);
}

TEST(Topology, DoesNotDependOnTheNumberingOfVerticesAndFaces) {
  const TriangleMesh mesh = joined(torus(3, 1, 12, 8), without_last_triangle(cube()));
  const Topology a = topology_of(mesh);
  const Topology b = topology_of(relabelled(mesh, 7));
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_EQ(a.vertex_manifold, b.vertex_manifold);
}

TEST(Topology, AnOpenMeshIsManifoldAndNotClosedAndHasNoGenus) {
  std::vector<std::string> notes;
  const Topology t = measure_topology(without_last_triangle(cube()), notes);
  EXPECT_FALSE(t.closed);
  EXPECT_TRUE(t.edge_manifold && t.vertex_manifold && t.oriented);
  EXPECT_EQ(t.euler_characteristic, 1);
  EXPECT_FALSE(t.genus.has_value());
  EXPECT_THAT(notes, Not(IsEmpty()));
}

TEST(Topology, AThirdTriangleOnAnEdgeIsNotManifold) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.emplace_back(5, 5, 5);
  mesh.triangles.push_back({0, 1, 4});
  const Topology t = topology_of(mesh);
  EXPECT_FALSE(t.edge_manifold);
  EXPECT_FALSE(t.vertex_manifold);
  EXPECT_FALSE(t.closed);
}

TEST(Topology, ABowTieVertexIsEdgeManifoldButNotVertexManifold) {
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), {2, 2, 2}));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t)
      if (v == 4) v = 0;
  const Topology t = topology_of(mesh);
  EXPECT_TRUE(t.closed && t.edge_manifold && t.oriented);
  EXPECT_FALSE(t.vertex_manifold);
  EXPECT_EQ(t.components, 1U) << "triangles that share a vertex are connected";
  EXPECT_EQ(t.isolated_vertices, 1U);
  EXPECT_EQ(t.euler_characteristic, 3) << "a point in no triangle is not a vertex of the surface";
}

TEST(Topology, AFlippedTriangleIsNotOriented) {
  TriangleMesh mesh = icosphere(1);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const Topology t = topology_of(mesh);
  EXPECT_FALSE(t.oriented);
  EXPECT_TRUE(t.closed && t.edge_manifold && t.vertex_manifold);
  EXPECT_TRUE(topology_of(reversed(icosphere(1))).oriented) << "inwards as a whole is consistent";
}

TEST(Topology, CountsIsolatedDuplicateAndNonFiniteVertices) {
  TriangleMesh mesh = cube();
  mesh.points.push_back(mesh.points[0]);
  mesh.points.push_back(mesh.points[0]);
  mesh.points.emplace_back(-0.0, 0, 1);  // equals corner 4
  mesh.points.emplace_back(0, std::numeric_limits<double>::quiet_NaN(), 0);
  mesh.points.emplace_back(0, std::numeric_limits<double>::quiet_NaN(), 0);
  mesh.points.emplace_back(0, 0, -std::numeric_limits<double>::infinity());
  const Topology t = topology_of(mesh);
  EXPECT_EQ(t.isolated_vertices, 6U);
  EXPECT_EQ(t.duplicate_vertices, 3U);
  EXPECT_EQ(t.nonfinite_vertices, 3U);
  EXPECT_EQ(t.genus, 0) << "points in no triangle do not matter";
}

TEST(Topology, DegenerateTrianglesAreDecidedExactly) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.2, 0.2, std::nextafter(0.2, 1)}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}};
  EXPECT_EQ(topology_of(mesh).degenerate_triangles, 2U) << "one ulp off the line is not on it; a vertex twice is";
}

TEST(Topology, AFaceThatNamesAVertexTwiceIsNotManifold) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 0, 1});
  const Topology t = topology_of(mesh);
  EXPECT_EQ(t.edges, 18U);
  EXPECT_FALSE(t.edge_manifold);
}

TEST(Topology, AnEmptyMeshIsMeasured) {
  const Topology t = topology_of({});
  EXPECT_EQ(t.vertices + t.triangles + t.edges + t.components, 0U);
  EXPECT_FALSE(t.closed);
  EXPECT_FALSE(t.genus.has_value());
}

}  // namespace
}  // namespace smopt::metrics
