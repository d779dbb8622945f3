#include "smopt/mesh/rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "smopt/mesh/stars.h"
#include "tests/mesh/meshes.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<TriangleMesh> closed_meshes() {
  return {tetrahedron(),
          cube(),
          icosphere(2),
          torus(3, 1, 12, 7),
          joined(cube(), translated(tetrahedron(), {5, 0, 0})),
          bipyramid(100),
          bipyramid(3),
          relabelled(icosphere(2), 7)};
}

TEST(Stars, ListEachCornerOnceInAscendingOrder) {
  for (const TriangleMesh& mesh : closed_meshes()) {
    const VertexStars stars = build_stars(mesh);
    ASSERT_EQ(stars.offsets.size(), mesh.vertex_count() + 1);
    EXPECT_EQ(stars.faces.size(), 3 * mesh.triangle_count());
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      std::vector<FaceId> expected;
      for (FaceId f = 0; f < mesh.triangle_count(); ++f)
        for (const VertexId corner : mesh.triangles[f])
          if (corner == v) expected.push_back(f);
      EXPECT_TRUE(std::ranges::equal(stars[v], expected)) << "vertex " << v;
    }
  }
}

TEST(Stars, ARepeatedCornerCountsTwiceAndAnUnusedVertexNotAtAll) {
  const TriangleMesh mesh{std::vector<Vec3>(4, Vec3::Zero()), {{1, 1, 2}, {2, 1, 0}}};
  const VertexStars stars = build_stars(mesh);
  EXPECT_THAT(stars[0], ElementsAre(1));
  EXPECT_THAT(stars[1], ElementsAre(0, 0, 1));
  EXPECT_THAT(stars[2], ElementsAre(0, 1));
  EXPECT_THAT(stars[3], IsEmpty());
}

TEST(Stars, OfAnEmptyMeshAreEmpty) {
  const VertexStars stars = build_stars({});
  EXPECT_THAT(stars.offsets, ElementsAre(0));
  EXPECT_THAT(stars.faces, IsEmpty());
}

TEST(Stars, CornerOfSaysWhereAVertexStands) {
  const Triangle t{7, 3, 9};
  EXPECT_EQ(corner_of(t, 7), 0);
  EXPECT_EQ(corner_of(t, 3), 1);
  EXPECT_EQ(corner_of(t, 9), 2);
}

/// Triangle i of each ring has the corners v, ring[i], ring[i + 1] in this cyclic order, and the ring has each triangle of v once.
void expect_rings_go_round(const TriangleMesh& mesh, const VertexRings& rings) {
  const VertexStars stars = build_stars(mesh);
  ASSERT_EQ(rings.vertex_count(), mesh.vertex_count());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const auto vertices = rings.vertices(v);
    const auto faces = rings.faces(v);
    ASSERT_EQ(vertices.size(), rings.valence(v));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Triangle& t = mesh.triangles[faces[i]];
      const int at = corner_of(t, v);
      ASSERT_EQ(t[at], v);
      ASSERT_EQ(t[(at + 1) % 3], vertices[i]);
      ASSERT_EQ(t[(at + 2) % 3], vertices[(i + 1) % vertices.size()]);
    }
    ASSERT_EQ(std::set<FaceId>(faces.begin(), faces.end()), std::set<FaceId>(stars[v].begin(), stars[v].end())) << "vertex " << v;
    ASSERT_EQ(faces.size(), stars[v].size());
  }
}

TEST(Rings, GoRoundEachVertexOfAClosedManifold) {
  for (const TriangleMesh& mesh : closed_meshes()) {
    const std::optional<VertexRings> rings = build_rings(mesh);
    ASSERT_TRUE(rings.has_value());
    expect_rings_go_round(mesh, *rings);
  }
}

TEST(Rings, VerticesWithoutTrianglesHaveAnEmptyRing) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.insert(mesh.points.begin(), Vec3::Zero());
  mesh.points.push_back(Vec3::Zero());
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) ++v;
  const std::optional<VertexRings> rings = build_rings(mesh);
  ASSERT_TRUE(rings.has_value());
  EXPECT_EQ(rings->valence(0), 0U);
  EXPECT_EQ(rings->valence(1), 3U);
  EXPECT_EQ(rings->valence(5), 0U);
  expect_rings_go_round(mesh, *rings);
}

TEST(Rings, ThereAreNoneForWhatIsNoClosedOrientedManifold) {
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  TriangleMesh flipped = icosphere(1);
  std::swap(flipped.triangles[10][0], flipped.triangles[10][1]);
  TriangleMesh doubled = icosphere(1);
  doubled.triangles.push_back(doubled.triangles[10]);
  TriangleMesh bow_tie = joined(tetrahedron(), translated(tetrahedron(), {5, 0, 0}));
  for (Triangle& t : bow_tie.triangles) std::replace(t.begin(), t.end(), 4U, 0U);
  TriangleMesh repeated = icosphere(1);
  repeated.triangles[10][0] = repeated.triangles[10][1];
  EXPECT_FALSE(build_rings(open).has_value());
  EXPECT_FALSE(build_rings(flipped).has_value());
  EXPECT_FALSE(build_rings(doubled).has_value());
  EXPECT_FALSE(build_rings(bow_tie).has_value());
  EXPECT_FALSE(build_rings(repeated).has_value());
  EXPECT_FALSE(build_rings(closed_lattice(5, 5, true)).has_value()) << "a Klein bottle";
}

/// A star by itself: whether it forms a ring around vertex 0.
struct Attempt {
  bool is_ring;
  std::vector<VertexId> vertices;
  std::vector<FaceId> faces;
};
Attempt ring_of(const std::vector<Triangle>& star) {
  const TriangleMesh mesh{std::vector<Vec3>(10, Vec3::Zero()), star};
  std::vector<FaceId> all;
  for (FaceId f = 0; f < star.size(); ++f) all.push_back(f);
  Attempt attempt{false, {77}, {88}};
  attempt.is_ring = append_ring(mesh, 0, all, attempt.vertices, attempt.faces);
  return attempt;
}

TEST(Rings, AppendPutsTheRingBehindWhatIsThere) {
  const Attempt attempt = ring_of({{0, 1, 2}, {3, 0, 2}, {3, 1, 0}});
  EXPECT_TRUE(attempt.is_ring);
  ASSERT_EQ(attempt.vertices.size(), 4U);
  EXPECT_EQ(attempt.vertices[0], 77U);
  EXPECT_EQ(attempt.faces[0], 88U);
}

TEST(Rings, AppendLeavesEverythingAsItWasWhereThereIsNoRing) {
  const std::vector<std::vector<Triangle>> stars = {
      {{0, 1, 2}, {0, 2, 3}},                                              // an open fan
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}},                                   // an open fan of three
      {{0, 1, 2}, {0, 2, 1}},                                              // two triangles back to back
      {{0, 1, 2}},                                                         // one
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}},  // two fans
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 4}},                        // an edge with three triangles
      {{0, 1, 2}, {0, 3, 2}, {0, 3, 1}},                                   // orientations that disagree
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 1}},  // every triangle twice
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 2}},                        // a loop with a tail
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 4}, {0, 4, 5}, {0, 5, 1}},  // twice through the vertex where it begins
  };
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const Attempt attempt = ring_of(stars[i]);
    EXPECT_FALSE(attempt.is_ring) << "star " << i;
    EXPECT_THAT(attempt.vertices, ElementsAre(77U)) << "star " << i;
    EXPECT_THAT(attempt.faces, ElementsAre(88U)) << "star " << i;
  }
}

TEST(Rings, AreFoundForEveryValenceInAnyOrder) {
  for (int valence = 3; valence <= 40; ++valence)
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
      const TriangleMesh mesh = relabelled(bipyramid(valence), seed);
      const std::optional<VertexRings> rings = build_rings(mesh);
      ASSERT_TRUE(rings.has_value()) << "valence " << valence << ", seed " << seed;
      expect_rings_go_round(mesh, *rings);
    }
}

TEST(Rings, AVertexOfTenThousandTrianglesIsNoMatter) {
  const TriangleMesh mesh = relabelled(bipyramid(10000), 3);
  const std::optional<VertexRings> rings = build_rings(mesh);
  ASSERT_TRUE(rings.has_value());
  expect_rings_go_round(mesh, *rings);
}

}  // namespace
}  // namespace smopt
