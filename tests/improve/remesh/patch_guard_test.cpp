#include "smopt/improve/remesh/patch_guard.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/patch_maker.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;

/// Plate of 4 × 4 unit squares, 1 thick, top at z = 0.5; point (i, j) of the top is 5 i + j, diagonals run from (i, j) to (i + 1, j + 1).
constexpr VertexId top(int i, int j) {
  return static_cast<VertexId>(5 * i + j);
}

/// A plate whose middle vertex on top is raised to a height above it.
TriangleMesh tent(double height) {
  TriangleMesh mesh = plate(4, 1);
  mesh.points[top(2, 2)].z() += height;
  return mesh;
}

/// The guard's answer about one operation of a fresh surface; it must be possible.
bool is_ok(const TriangleMesh& mesh, OperationKind kind, VertexId v, VertexId w) {
  PatchMaker maker(mesh);
  EXPECT_TRUE(maker.propose(kind, v, w));
  return maker.is_ok();
}

TEST(PatchGuard, AllowsWhatIsFree) {
  EXPECT_TRUE(is_ok(plate(4, 1), kFlip, top(1, 1), top(2, 2)));
  EXPECT_TRUE(is_ok(plate(4, 1), kCollapse, top(2, 2), top(2, 3)));
  EXPECT_TRUE(is_ok(plate(4, 1), kSplit, top(1, 1), top(2, 2)));
  EXPECT_TRUE(is_ok(tent(2), kCollapse, top(2, 2), top(2, 3)));
  EXPECT_TRUE(is_ok(tent(2), kFlip, top(2, 2), top(3, 3)));
}

/// The quadrilateral of the edge from (1, 1) to (2, 2) with its left corner (1, 2) moved so that the angle at (2, 2) is less than straight,
/// exactly straight, or more.
TriangleMesh dart(double x) {
  TriangleMesh mesh = plate(4, 1);
  mesh.points[top(1, 2)] = Vec3(x, 2.5, 0.5);  // seen from (2, 2) opposite to the right corner (2, 1) + (0.5, 0.5) where x is 1.5
  mesh.points[top(2, 1)] = Vec3(2.5, 1.5, 0.5);
  return mesh;
}

TEST(PatchGuard, RefusesAFoldInOnePlaneAndADegenerateTriangle) {
  // The line from (2.5, 1.5) through (2, 2) goes on to (1.5, 2.5).
  for (const double x : {1.25, 1.5, 1.75}) {
    SCOPED_TRACE(x);
    ASSERT_THAT(dart(x), HasNoIntersections());
    PatchMaker maker(dart(x));
    ASSERT_TRUE(maker.propose(kFlip, top(1, 1), top(2, 2)));
    EXPECT_EQ(maker.is_ok(), x < 1.5);
    EXPECT_EQ(intersecting_pairs(maker.mesh_after()).empty(), x < 1.5);
  }
}

TEST(PatchGuard, RefusesACollapseThatFoldsInOnePlane) {
  TriangleMesh mesh = plate(4, 1);
  mesh.points[top(2, 3)] = Vec3(1.5, 2.25, 0.5);  // a dent in the ring of the middle, on the far side of which (2, 4)'s triangles are
  ASSERT_THAT(mesh, HasNoIntersections());
  int refused = 0;
  for (const VertexId w : {top(1, 1), top(1, 2), top(2, 1), top(2, 3), top(3, 2), top(3, 3)}) {
    PatchMaker maker(mesh);
    ASSERT_TRUE(maker.propose(kCollapse, top(2, 2), w));
    const bool folds = !intersecting_pairs(maker.mesh_after()).empty();
    EXPECT_EQ(maker.is_ok(), !folds) << "to " << w;
    refused += folds ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
}

TEST(PatchGuard, RefusesACollapseThatMakesATriangleDegenerate) {
  // Pulled to (2, 3), the star gets a triangle on the line from there through (1, 2.5) to (0, 2).
  TriangleMesh mesh = plate(4, 1);
  mesh.points[top(1, 2)] = Vec3(1.25, 2, 0.5);
  mesh.points[top(1, 1)] = Vec3(0.5, 1, 0.5);  // (2, 3), (1.25, 2) and (0.5, 1) are on one line
  ASSERT_THAT(mesh, HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, kCollapse, top(2, 2), top(2, 3)));
  mesh.points[top(1, 1)].x() += std::ldexp(1, -40);
  const bool bends_out = is_ok(mesh, kCollapse, top(2, 2), top(2, 3));
  mesh.points[top(1, 1)].x() -= std::ldexp(1, -39);
  EXPECT_NE(is_ok(mesh, kCollapse, top(2, 2), top(2, 3)), bends_out) << "on one side of the line there is a fold, on the other none";
}

TEST(PatchGuard, RefusesACollapseIntoAnotherSheet) {
  // A slab stands within the tent, higher than where the tent's roof comes down to.
  const TriangleMesh sheet = translated(scaled(plate(2, 0.25), 0.125), {1.875, 1.875, 1.5});  // within the tent, free of it
  const TriangleMesh mesh = joined(tent(4), sheet);
  ASSERT_THAT(mesh, HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, kCollapse, top(2, 2), top(2, 3)));
  EXPECT_TRUE(is_ok(joined(tent(4), translated(sheet, {0, 0, 5})), kCollapse, top(2, 2), top(2, 3)));
}

/// The four corners of a flat quadrilateral's flip with a small thing between the two diagonals.
TriangleMesh ridge() {
  TriangleMesh mesh = plate(4, 1);
  mesh.points[top(1, 1)].z() += 0.5;  // the edge between these two is a ridge half a unit above the other diagonal
  mesh.points[top(2, 2)].z() += 0.5;
  return mesh;
}

TEST(PatchGuard, RefusesAFlipThatWouldSweepOverAComponentThatIsFreeAtBothEnds) {
  // The tetrahedron of the flip has its middle at (1.5, 1.5, 0.75).
  const TriangleMesh speck = translated(scaled(octahedron(), 0.0625), {1.5, 1.5, 0.75});
  const TriangleMesh mesh = joined(ridge(), speck);
  ASSERT_THAT(mesh, HasNoIntersections());
  PatchMaker maker(mesh);
  ASSERT_TRUE(maker.propose(kFlip, top(1, 1), top(2, 2)));
  ASSERT_THAT(maker.mesh_after(), HasNoIntersections());
  EXPECT_FALSE(maker.is_ok());
  EXPECT_TRUE(is_ok(joined(ridge(), translated(speck, {0, 0, 1})), kFlip, top(1, 1), top(2, 2))) << "the same speck outside";
  EXPECT_TRUE(is_ok(ridge(), kFlip, top(1, 1), top(2, 2)));
}

TEST(PatchGuard, RefusesAFlipIntoASheetAndAllowsTheLastDoubleBeforeIt) {
  // Flipping the valley between (1, 1) and (2, 2) raises it to the other diagonal's height; a plate lies in between or just above.
  TriangleMesh valley = plate(4, 1);
  valley.points[top(1, 2)].z() += 0.5;
  valley.points[top(2, 1)].z() += 0.5;  // the diagonal between these two is at z = 1
  const auto with_lid = [&](double bottom) {
    TriangleMesh lid = scaled(plate(2, 0.5), 0.0625);  // 0.125 wide
    double lowest = lid.points[0].z();
    for (const Vec3& p : lid.points) lowest = std::min(lowest, p.z());
    for (Vec3& p : lid.points) p = Vec3(p.x() + 1.4375, p.y() + 1.4375, p.z() == lowest ? bottom : bottom + 0.1);
    return joined(valley, lid);
  };
  ASSERT_THAT(with_lid(0.9), HasNoIntersections());
  EXPECT_FALSE(is_ok(with_lid(0.9), kFlip, top(1, 1), top(2, 2)));
  EXPECT_FALSE(is_ok(with_lid(1.0), kFlip, top(1, 1), top(2, 2))) << "touching counts";
  EXPECT_TRUE(is_ok(with_lid(std::nextafter(1.0, 2.0)), kFlip, top(1, 1), top(2, 2)));
}

TEST(PatchGuard, RefusesToPassThroughASheetWithoutTouchingItAtTheEnd) {
  // A spike of valence 6 and length 8 with a thin plate inside: none of the new triangles is near the plate.
  const TriangleMesh thin = translated(scaled(plate(2, 1e-6), 0.05), {1.95, 1.95, 3});
  const TriangleMesh mesh = joined(tent(8), thin);
  ASSERT_THAT(mesh, HasNoIntersections());
  for (const VertexId w : {top(1, 1), top(1, 2), top(2, 1), top(2, 3), top(3, 2), top(3, 3)}) {
    PatchMaker maker(mesh);
    ASSERT_TRUE(maker.propose(kCollapse, top(2, 2), w));
    ASSERT_THAT(maker.mesh_after(), HasNoIntersections());
    EXPECT_FALSE(maker.is_ok()) << "to " << w;
  }
}

TEST(PatchGuard, RefusesToLeaveAComponentOutsideWithItsCornersOnTheWalls) {
  // The collapse goes along the line from u to w; the tetrahedra that it sweeps have walls with this line and (1, 1), (2, 1), (3, 2).
  const TriangleMesh mesh = tent(8);
  const Vec3 u = mesh.points[top(2, 2)], w = mesh.points[top(2, 3)];
  const auto on_wall = [&](double part, VertexId r) { return Vec3(part * u + (0.5 - part) * w + 0.5 * mesh.points[r]); };
  TriangleMesh small{{on_wall(0.25, top(1, 1)), on_wall(0.375, top(1, 1)), on_wall(0.25, top(2, 1)), on_wall(0.25, top(3, 2))},
                     {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  if (enclosed_volume(small) < 0) small = reversed(small);
  ASSERT_THAT(joined(mesh, small), HasNoIntersections());
  EXPECT_TRUE(is_ok(mesh, kCollapse, top(2, 2), top(2, 3)));
  EXPECT_FALSE(is_ok(joined(mesh, small), kCollapse, top(2, 2), top(2, 3)));
}

// ---- Against an oracle ----

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Whether p is strictly inside of the tetrahedron.
bool is_strictly_inside(const std::array<Vec3, 4>& t, const Vec3& p) {
  const auto sign = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return CGAL::orientation(exact(a), exact(b), exact(c), exact(d));
  };
  const auto whole = sign(t[0], t[1], t[2], t[3]);
  return whole != CGAL::ZERO && sign(p, t[1], t[2], t[3]) == whole && sign(t[0], p, t[2], t[3]) == whole &&
         sign(t[0], t[1], p, t[3]) == whole && sign(t[0], t[1], t[2], p) == whole;
}

/// What a patch sweeps over, told from the operation: a collapse moves the old star's triangles to the new place; others swap the diagonals.
std::vector<std::array<VertexId, 4>> swept_by(const Patch& patch, VertexId v, VertexId w, OperationKind kind) {
  const std::size_t n = patch.boundary.size();
  if (kind == kSplit) return {};
  if (kind == kFlip) return {{patch.boundary[0], patch.boundary[1], patch.boundary[2], patch.boundary[3]}};
  std::vector<std::array<VertexId, 4>> result;
  for (std::size_t k = 0; k < n; ++k) {
    const VertexId a = patch.boundary[k], b = patch.boundary[(k + 1) % n];
    if (a != w && b != w) result.push_back({v, w, a, b});
  }
  return result;
}

bool swallows_a_vertex(const PatchMaker& maker, const std::vector<std::array<VertexId, 4>>& swept) {
  const EditableSurface& surface = maker.surface();
  for (const auto& ids : swept) {
    const std::array<Vec3, 4> corners = {surface.point(ids[0]), surface.point(ids[1]), surface.point(ids[2]), surface.point(ids[3])};
    for (VertexId v = 0; v < surface.mesh().vertex_count(); ++v) {
      if (!surface.is_in_use(v) || std::find(ids.begin(), ids.end(), v) != ids.end()) continue;
      if (is_strictly_inside(corners, surface.point(v))) return true;
    }
  }
  return false;
}

/// Whether the surface meets itself while the vertex of a collapse is on its way; the moments are samples.
bool meets_on_the_way(const PatchMaker& maker, VertexId v, VertexId w, int samples) {
  TriangleMesh mesh = maker.mesh();
  const Vec3 from = mesh.points[v], to = mesh.points[w];
  for (int i = 1; i < samples; ++i) {
    mesh.points[v] = from + (to - from) * i / samples;
    if (!intersecting_pairs(mesh).empty()) return true;
  }
  return false;
}

struct CaseMesh {
  const char* name;
  TriangleMesh (*make)(std::uint32_t seed);
};

constexpr std::array<CaseMesh, 6> kCases = {{
    {"nested_and_near",
     [](std::uint32_t seed) {
       return joined(joined(noisy(icosphere(1), 0.1, seed), noisy(icosphere(0, 0.3), 0.1, seed + 1)),
                     noisy(torus(0.6, 0.1, 12, 6), 0.03, seed + 2));
     }},
    {"noisy", [](std::uint32_t seed) { return noisy(icosphere(2), 0.08, seed); }},
    {"sheets", [](std::uint32_t seed) { return plates_on_a_noisy_sheet(0.01, seed); }},
    {"needles", [](std::uint32_t seed) { return noisy(spiky(icosphere(1), 3, 2.5), 0.1, seed); }},
    {"flat",
     [](std::uint32_t seed) {
       TriangleMesh mesh = noisy(plate(6, 0.5), 0.25, seed);
       for (Vec3& p : mesh.points) p = (p * 8).array().round() / 8;  // many coplanar and collinear corners
       return mesh;
     }},
    {"specks_in_needles",
     [](std::uint32_t seed) {
       TriangleMesh mesh = spiky(noisy(icosphere(1), 0.05, seed), 5, 4);
       const TriangleMesh needles = mesh;
       for (std::size_t v = 0; v < needles.points.size(); v += 5) mesh = joined(mesh, icosphere(0, 0.02, 0.6 * needles.points[v]));
       return mesh;
     }},
}};

class RandomPatches : public ::testing::TestWithParam<CaseMesh> {};
INSTANTIATE_TEST_SUITE_P(PatchGuard, RandomPatches, ::testing::ValuesIn(kCases),
                         [](const auto& parameter) { return parameter.param.name; });

struct Tally {
  int accepted = 0, refused = 0, refused_in_vain = 0;
};

/// Tries random operations on a surface and makes those that are allowed, so that the guard has to know about what came before.
void try_patches(const TriangleMesh& start, std::uint32_t seed, int count, Tally& tally) {
  PatchMaker maker(start);
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    VertexId v = 0;
    do v = static_cast<VertexId>(random.integer(0, static_cast<int>(maker.surface().mesh().vertex_count()) - 1));
    while (!maker.surface().is_in_use(v));
    const auto ring = maker.surface().rings().vertices(v);
    const VertexId w = ring[static_cast<std::size_t>(random.integer(0, static_cast<int>(ring.size()) - 1))];
    const auto kind = static_cast<OperationKind>(random.integer(0, kOperationKinds - 1));
    if (kind == kSplit && random.coin()) continue;  // always free, and the mesh should not grow
    if (!maker.propose(kind, v, w) || !maker.surface().has_room_for(maker.patch())) continue;
    const bool ok = maker.is_ok();
    const bool meets = !intersecting_pairs(maker.mesh_after()).empty();
    const bool swallows = swallows_a_vertex(maker, swept_by(maker.patch(), v, w, kind));
    EXPECT_FALSE(ok && (meets || swallows)) << fmt::format("seed {}, attempt {}, operation {} from {} to {}: {}", seed, i,
                                                           static_cast<int>(kind), v, w, meets ? "meets" : "swallows");
    ok ? ++tally.accepted : ++tally.refused;
    if (!ok && !meets && !swallows && !(kind == kCollapse && meets_on_the_way(maker, v, w, 50))) ++tally.refused_in_vain;
    if (ok && random.coin()) maker.make();
  }
  EXPECT_THAT(maker.mesh(), HasNoIntersections());
  EXPECT_THAT(maker.mesh(), IsClosedManifold());
}

TEST_P(RandomPatches, AreAllowedOnlyWhereNothingIsMetAndHardlyEverRefusedElsewhere) {
  constexpr int kPerMesh = 300;
  constexpr std::uint32_t kWanted = 6;
  Tally tally;
  for (std::uint32_t seed = 1, used = 0; used < kWanted && seed < 100; ++seed) {
    const TriangleMesh start = GetParam().make(seed);
    if (!intersecting_pairs(start).empty()) continue;
    try_patches(start, seed, kPerMesh, tally);
    ++used;
  }
  fmt::print("{}: {} allowed, {} refused, {} of them in vain\n", GetParam().name, tally.accepted, tally.refused, tally.refused_in_vain);
  EXPECT_GT(tally.accepted, 100);
  EXPECT_GT(tally.refused, 20);
  EXPECT_LE(tally.refused_in_vain, tally.refused / 50) << "contacts between two samples";
}

}  // namespace
}  // namespace smopt
