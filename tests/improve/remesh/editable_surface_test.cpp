#include "smopt/improve/remesh/editable_surface.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "smopt/error.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/patch_maker.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::UnorderedElementsAreArray;

/// The ring's vertices, begun with the smallest.
std::vector<VertexId> turned(std::span<const VertexId> ring) {
  std::vector<VertexId> result(ring.begin(), ring.end());
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

/// The rings are those of the triangles in use, and each triangle is where its ring says.
void expect_rings_of_the_triangles(const PatchMaker& maker) {
  const VertexRings& rings = maker.surface().rings();
  const std::optional<VertexRings> anew = build_rings(maker.mesh());
  ASSERT_TRUE(anew.has_value());
  ASSERT_EQ(rings.vertex_count(), anew->vertex_count());
  for (VertexId v = 0; v < rings.vertex_count(); ++v) {
    ASSERT_EQ(rings.valence(v), anew->valence(v)) << v;
    ASSERT_EQ(maker.surface().is_in_use(v), rings.valence(v) > 0);
    if (rings.valence(v) == 0) continue;
    EXPECT_EQ(turned(rings.vertices(v)), turned(anew->vertices(v))) << v;
    EXPECT_LE(rings.valence(v), maker.surface().capacity(v));
    for (std::size_t i = 0; i < rings.valence(v); ++i) {
      const Triangle t = maker.surface().mesh().triangles[rings.faces(v)[i]];
      const VertexId a = rings.vertices(v)[i], b = rings.vertices(v)[(i + 1) % rings.valence(v)];
      EXPECT_TRUE((t == Triangle{v, a, b} || t == Triangle{a, b, v} || t == Triangle{b, v, a})) << v << " " << i;
      EXPECT_EQ(maker.surface().slot_of(v, a), i);
      EXPECT_TRUE(maker.surface().are_neighbours(v, a));
      EXPECT_TRUE(maker.surface().are_neighbours(a, v));
    }
  }
}

std::set<FaceId> faces_in_use(const EditableSurface& surface) {
  std::set<FaceId> used;
  for (VertexId v = 0; v < surface.mesh().vertex_count(); ++v) {
    const auto faces = surface.rings().faces(v);
    used.insert(faces.begin(), faces.end());
  }
  return used;
}

std::vector<FaceId> found_in(const TriangleGrid& grid, const Box& box) {
  std::vector<FaceId> found;
  grid.for_overlapping(box, [&](FaceId f) { found.push_back(f); });
  return found;
}

/// The grid finds every triangle in use where it is, each once, and no other.
void expect_grid_of_the_triangles(const EditableSurface& surface) {
  const TriangleGrid& grid = surface.guarded().grid;
  const TriangleMesh& mesh = surface.mesh();
  const std::set<FaceId> used = faces_in_use(surface);
  const auto box_of = [&](FaceId f) {
    const auto [a, b, c] = mesh.triangles[f];
    return grid.box_of(mesh.points[a], mesh.points[b], mesh.points[c]);
  };
  EXPECT_THAT(found_in(grid, grid.box_of(Vec3::Constant(-100), Vec3::Constant(100))), UnorderedElementsAreArray(used));
  for (const FaceId f : used) {
    const Box box = box_of(f);
    std::vector<FaceId> expected;
    for (const FaceId g : used)
      if (box.overlaps(box_of(g))) expected.push_back(g);
    ASSERT_THAT(found_in(grid, box), UnorderedElementsAreArray(expected)) << f;
  }
}

TEST(EditableSurface, KnowsItsRingsAndTrianglesAfterAnyOperations) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    for (const TriangleMesh& start : {noisy(icosphere(2), 0.05, seed), noisy(torus(1, 0.3, 24, 10), 0.02, seed), plate(4, 1)}) {
      PatchMaker maker(start);
      Random random(seed);
      int made = 0;
      for (int i = 0; i < 1500; ++i) made += maker.try_any(random) ? 1 : 0;
      EXPECT_GT(made, 100);
      expect_rings_of_the_triangles(maker);
      expect_grid_of_the_triangles(maker.surface());
      EXPECT_THAT(maker.mesh(), IsClosedManifold());
      EXPECT_EQ(euler_characteristic(maker.mesh()), euler_characteristic(start));
      const TriangleMesh compacted = maker.surface().compacted();
      EXPECT_THAT(compacted, IsClosedManifold());
      EXPECT_EQ(compacted.triangle_count(), maker.mesh().triangle_count());
      EXPECT_NEAR(enclosed_volume(compacted), enclosed_volume(maker.mesh()), 1e-12);
      EXPECT_TRUE(build_rings(compacted).has_value());
      const std::vector<std::size_t> valence = valences(compacted);
      EXPECT_GT(*std::min_element(valence.begin(), valence.end()), 2U);
    }
  }
}

TEST(EditableSurface, IsTheMeshWhileNothingWasDone) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.05, 1);
  const EditableSurface surface(mesh);
  EXPECT_TRUE(is_same(surface.compacted(), mesh));
}

TEST(EditableSurface, LetsNoRingGrowBeyondItsRoom) {
  PatchMaker maker(icosphere(2));
  Random random(5);
  for (int i = 0; i < 5000; ++i) maker.try_any(random);
  for (VertexId v = 0; v < maker.surface().mesh().vertex_count(); ++v) EXPECT_LE(maker.surface().valence(v), EditableSurface::kMaxValence);
}

TEST(EditableSurface, RefusesAMeshThatIsNotClosed) {
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  EXPECT_THROW(EditableSurface{open}, InvalidMesh);
}

TEST(EditableSurface, GivesSpareNumbersThatAreNotInUse) {
  PatchMaker maker(icosphere(1));
  EditableSurface& surface = maker.state().surface;
  const std::size_t vertices = surface.mesh().vertex_count(), faces = surface.mesh().triangle_count();
  for (const std::size_t wanted : {1U, 10U, 100U}) {
    const EditableSurface::Spare spare = surface.reserve(wanted);
    EXPECT_EQ(spare.vertices.size(), wanted);
    EXPECT_EQ(spare.faces.size(), 2 * wanted);
    const std::set<FaceId> used = faces_in_use(surface);
    EXPECT_EQ(std::set<VertexId>(spare.vertices.begin(), spare.vertices.end()).size(), wanted);
    EXPECT_EQ(std::set<FaceId>(spare.faces.begin(), spare.faces.end()).size(), 2 * wanted);
    for (const VertexId v : spare.vertices) EXPECT_FALSE(surface.is_in_use(v));
    for (const FaceId f : spare.faces) EXPECT_EQ(used.count(f), 0U);
  }
  EXPECT_EQ(surface.compacted().vertex_count(), vertices);
  EXPECT_EQ(surface.compacted().triangle_count(), faces);
}

// ---- The link condition ----

TEST(EdgeCollapse, KeepsATetrahedronAndWhatWouldPinchASurface) {
  PatchMaker solid(tetrahedron());
  EXPECT_FALSE(solid.propose(kCollapse, 0, 1));
  // Two tetrahedra on a common base that is no face: its corners have valence 4, the tips 3.
  TriangleMesh tips{{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}}, {}};
  tips.triangles = {{2, 3, 0}, {3, 4, 0}, {4, 2, 0}, {3, 2, 1}, {4, 3, 1}, {2, 4, 1}};
  PatchMaker bipyramid(tips);
  EXPECT_FALSE(bipyramid.propose(kCollapse, 2, 3)) << "the base would become an edge with four triangles";
  EXPECT_TRUE(bipyramid.propose(kCollapse, 0, 2)) << "a tip comes down onto the base";
  // Around the tube edges form cycles of three that bound nothing.
  const TriangleMesh tube = torus(1, 0.2, 12, 3);
  PatchMaker ring(tube);
  EXPECT_FALSE(ring.propose(kCollapse, 0, 1));
}

TEST(EdgeFlip, IsNoneWhereTheOtherDiagonalIsAnEdgeAlready) {
  PatchMaker solid(tetrahedron());
  for (const VertexId w : {1U, 2U, 3U}) EXPECT_FALSE(solid.propose(kFlip, 0, w));
}

TEST(EdgeSplit, PutsAVertexInTheMiddleOfTheEdge) {
  const TriangleMesh mesh = icosphere(1);
  PatchMaker maker(mesh);
  const VertexId v = 3, w = maker.surface().rings().vertices(v)[1];
  ASSERT_TRUE(maker.propose(kSplit, v, w));
  const VertexId added = maker.patch().added;
  EXPECT_EQ(maker.surface().point(added), Vec3(0.5 * (mesh.points[v] + mesh.points[w])));
  EXPECT_TRUE(maker.is_ok());
  maker.make();
  EXPECT_EQ(maker.surface().valence(added), 4U);
  EXPECT_EQ(maker.surface().compacted().vertex_count(), mesh.vertex_count() + 1);
  EXPECT_NEAR(enclosed_volume(maker.mesh()), enclosed_volume(mesh), 1e-14);
}

}  // namespace
}  // namespace smopt
