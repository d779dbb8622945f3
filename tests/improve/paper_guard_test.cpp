#include "smopt/improve/paper_guard.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmock/gmock.h>

#include <random>
#include <set>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::IsEmpty;
using ::testing::Not;

// ---- Algorithm 2 ----

/// Whether a closed segment and a closed triangle meet, by CGAL's exact kernel.
bool meet_exactly(const Vec3& q1, const Vec3& q2, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  return CGAL::do_intersect(Kernel::Segment_3(point(q1), point(q2)), Kernel::Triangle_3(point(p1), point(p2), point(p3)));
}

class RandomPoints {
 public:
  explicit RandomPoints(std::uint32_t seed) : random_(seed) {}
  double number() { return uniform_(random_); }
  Vec3 operator()() { return {number(), number(), number()}; }
  VertexId vertex_of(const TriangleMesh& mesh) { return static_cast<VertexId>(random_() % mesh.vertex_count()); }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(EdgeMeetsTriangleAsPrinted, IsRightInGeneralPosition) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    RandomPoints random(3);
    int meeting = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p1 = scale * random(), p2 = scale * random(), p3 = scale * random(), q1 = scale * random(), q2 = scale * random();
      const bool meet = meet_exactly(q1, q2, p1, p2, p3);
      ASSERT_EQ(edge_meets_triangle_as_printed(q1, q2, p1, p2, p3), meet) << "case " << i << ", scale " << scale;
      meeting += static_cast<int>(meet);
    }
    EXPECT_GT(meeting, 100);
    EXPECT_LT(meeting, 2900);
  }
}

TEST(EdgeMeetsTriangleAsPrinted, DoesNotDependOnTheOrderOfPointsInGeneralPosition) {
  RandomPoints random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p1 = random(), p2 = random(), p3 = random(), q1 = random(), q2 = random();
    const bool meet = edge_meets_triangle_as_printed(q1, q2, p1, p2, p3);
    EXPECT_EQ(edge_meets_triangle_as_printed(q2, q1, p1, p2, p3), meet);
    EXPECT_EQ(edge_meets_triangle_as_printed(q1, q2, p2, p3, p1), meet);
    EXPECT_EQ(edge_meets_triangle_as_printed(q1, q2, p3, p2, p1), meet);
  }
}

TEST(EdgeMeetsTriangleAsPrinted, CountsContact) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_TRUE(edge_meets_triangle_as_printed({1, 1, 0}, {1, 1, 3}, a, b, c)) << "an end on the face";
  EXPECT_TRUE(edge_meets_triangle_as_printed({2, 2, -1}, {2, 2, 1}, a, b, c)) << "through an edge";
  EXPECT_TRUE(edge_meets_triangle_as_printed({0, 0, -1}, {0, 0, 1}, a, b, c)) << "through a corner";
  EXPECT_FALSE(edge_meets_triangle_as_printed({1, 1, 0.25}, {1, 1, 3}, a, b, c));
  EXPECT_FALSE(edge_meets_triangle_as_printed({2.25, 2, -1}, {2.25, 2, 1}, a, b, c));
}

TEST(EdgeMeetsTriangleAsPrinted, TakesAnEdgeInTheTrianglesPlaneForMeetingHoweverFarAway) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  for (const double distance : {8.0, 64.0, 4096.0}) {
    const Vec3 q1(distance, 1, 0), q2(distance, 3, 0);
    ASSERT_FALSE(meet_exactly(q1, q2, a, b, c));
    EXPECT_TRUE(edge_meets_triangle_as_printed(q1, q2, a, b, c)) << distance;
  }
}

TEST(EdgeMeetsTriangleAsPrinted, TakesAnEdgeThatSharesACornerForMeeting) {
  RandomPoints random(5);
  for (int i = 0; i < 200; ++i) {
    // Multiples of 1/64: the products that are zero are so exactly.
    const auto whole = [&] { return Vec3((64 * random()).array().round() / 64); };
    const std::array<Vec3, 3> p{whole(), whole(), whole()};
    for (const Vec3& shared : p) EXPECT_TRUE(edge_meets_triangle_as_printed(shared, whole(), p[0], p[1], p[2])) << "case " << i;
  }
}

// ---- The guard ----

/// The answer of the paper's guard about one move.
bool is_ok(const TriangleMesh& start, VertexId v, const Vec3& target, int vicinity) {
  TriangleMesh mesh = start;
  const VertexRings rings = build_rings(mesh).value();
  StarMove move(mesh, rings);
  PaperGuard guard(mesh, rings, vicinity);
  guard.enter({&v, 1}, nullptr);
  move.select(v);
  guard.select(move, target);
  EXPECT_TRUE(guard.is_within_region());
  EXPECT_FALSE(guard.must_wait());
  move.aim(target);
  return guard.is_ok();
}

TriangleMesh moved(TriangleMesh mesh, VertexId v, const Vec3& target) {
  mesh.points[v] = target;
  return mesh;
}

/// The triangles that a path of `rings` triangles, each sharing a vertex with the next, joins to the vertex.
std::set<FaceId> faces_within(const TriangleMesh& mesh, VertexId v, int rings) {
  std::set<VertexId> vertices{v};
  std::set<FaceId> faces;
  for (int ring = 0; ring < rings; ++ring) {
    for (FaceId f = 0; f < mesh.triangle_count(); ++f)
      if (std::ranges::any_of(mesh.triangles[f], [&](VertexId w) { return vertices.count(w) > 0; })) faces.insert(f);
    for (const FaceId f : faces) vertices.insert(mesh.triangles[f].begin(), mesh.triangles[f].end());
  }
  return faces;
}

/// Whether an edge of one of the faces meets one of the others at rest, sharing no vertex with it; exactly.
bool has_edge_through(const TriangleMesh& mesh, const std::set<FaceId>& edges_of, const std::set<FaceId>& faces) {
  for (const FaceId f : edges_of) {
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = mesh.triangles[f][i], to = mesh.triangles[f][(i + 1) % 3];
      for (const FaceId g : faces) {
        const Triangle& t = mesh.triangles[g];
        if (std::ranges::count(t, from) + std::ranges::count(t, to) > 0) continue;
        if (meet_exactly(mesh.points[from], mesh.points[to], mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]])) return true;
      }
    }
  }
  return false;
}

/// The guard's description done with exact predicates; the same in general position.
bool is_ok_exactly(const TriangleMesh& mesh, VertexId v, const Vec3& target, int vicinity) {
  const TriangleMesh after = moved(mesh, v, target);
  const std::set<FaceId> star = faces_within(mesh, v, 1), around = faces_within(mesh, v, vicinity);
  return !has_edge_through(after, star, around) && !has_edge_through(after, around, star);
}

struct RandomMove {
  TriangleMesh mesh;
  VertexId vertex;
  Vec3 target;
};

/// Moves of rough meshes in general position, many of them too far.
std::vector<RandomMove> random_moves(int count) {
  RandomPoints random(7);
  std::vector<RandomMove> moves;
  while (static_cast<int>(moves.size()) < count) {
    const auto seed = static_cast<std::uint32_t>(moves.size());
    const TriangleMesh mesh = relabelled(joined(noisy(icosphere(1), 0.1, seed), noisy(torus(0.6, 0.12, 14, 6), 0.03, seed)), seed);
    if (!intersecting_pairs(mesh).empty()) {
      moves.push_back({noisy(icosphere(1), 0.05, seed), 0, random()});
      continue;
    }
    const VertexId v = random.vertex_of(mesh);
    moves.push_back({mesh, v, mesh.points[v] + std::pow(10.0, 0.6 * random.number() - 0.4) * random()});
  }
  return moves;
}

TEST(PaperGuard, DecidesAsItsDescriptionDoesInGeneralPosition) {
  int accepted = 0, refused = 0;
  for (const auto& [mesh, vertex, target] : random_moves(120)) {
    for (const int vicinity : {1, 2, 3}) {
      const bool ok = is_ok(mesh, vertex, target, vicinity);
      EXPECT_EQ(ok, is_ok_exactly(mesh, vertex, target, vicinity)) << "vertex " << vertex << ", vicinity " << vicinity;
      ok ? ++accepted : ++refused;
    }
  }
  EXPECT_GT(accepted, 40);
  EXPECT_GT(refused, 40);
}

TEST(PaperGuard, RefusesWithALargerVicinityWhatItRefusesWithASmallerOne) {
  std::array<int, 5> refused{};
  for (const auto& [mesh, vertex, target] : random_moves(400)) {
    bool was_refused = false;
    for (int vicinity = 1; vicinity <= 4; ++vicinity) {
      const bool is_refused = !is_ok(mesh, vertex, target, vicinity);
      EXPECT_TRUE(is_refused || !was_refused) << "vertex " << vertex << ", vicinity " << vicinity;
      was_refused = is_refused;
      refused[static_cast<std::size_t>(vicinity)] += static_cast<int>(is_refused);
    }
  }
  EXPECT_LT(refused[1], refused[2]) << "the star alone sees less";
  EXPECT_LT(refused[2], refused[3]);
}

/// Plate of 4 × 4 squares; the point in the middle of its top is at (2, 2, 0.5).
constexpr VertexId kMiddle = 2 * 5 + 2;

TEST(PaperGuard, LetsAStarThroughAnotherComponentHoweverLargeItsVicinity) {
  const TriangleMesh mesh = joined(noisy(plate(4, 1), 0.01, 1), translated(noisy(plate(4, 0.2), 0.01, 2), {0.1, 0.2, 2}));
  const Vec3 target(2.03, 2.02, 3);
  ASSERT_THAT(mesh, HasNoIntersections());
  ASSERT_THAT(moved(mesh, kMiddle, target), Not(HasNoIntersections()));
  for (const int vicinity : {1, 2, 3, 20}) EXPECT_TRUE(is_ok(mesh, kMiddle, target, vicinity)) << vicinity;
}

TEST(PaperGuard, LetsAStarThroughTheOtherSideOfItsComponentUntilItsVicinityReachesThere) {
  const TriangleMesh mesh = noisy(plate(8, 0.5), 0.02, 2);
  constexpr VertexId kMiddleOfEight = 4 * 9 + 4;
  const Vec3 target = mesh.points[kMiddleOfEight] - Vec3(0.01, 0.02, 1);
  ASSERT_THAT(mesh, HasNoIntersections());
  ASSERT_THAT(moved(mesh, kMiddleOfEight, target), Not(HasNoIntersections()));
  EXPECT_TRUE(is_ok(mesh, kMiddleOfEight, target, 2));
  EXPECT_TRUE(is_ok(mesh, kMiddleOfEight, target, 3));
  EXPECT_FALSE(is_ok(mesh, kMiddleOfEight, target, 10));
}

TEST(PaperGuard, RefusesACrossingWithinItsVicinity) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.05, 3);
  const VertexRings rings = build_rings(mesh).value();
  int crossings = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const std::set<FaceId> star = faces_within(mesh, v, 1);
    for (const FaceId f : faces_within(mesh, v, 2)) {
      if (star.count(f) > 0) continue;
      const auto& [a, b, c] = mesh.triangles[f];
      const Vec3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
      const Vec3 target = middle + 0.1 * middle.normalized();  // outside: the spokes to the ring's far side come out there
      if (!has_edge_through(moved(mesh, v, target), star, faces_within(mesh, v, 2))) continue;
      ++crossings;
      EXPECT_FALSE(is_ok(mesh, v, target, 2)) << "vertex " << v << ", face " << f;
    }
  }
  EXPECT_GT(crossings, 10);
}

TEST(PaperGuard, LetsAMoveJumpPastASheetAsItLooksAtTheTargetOnly) {
  // The tip of a flat pyramid goes through the square base and beyond; at rest nothing meets.
  const TriangleMesh mesh = noisy(octahedron(), 0.03, 4);
  const Vec3 below = 1.4 * mesh.points[5];
  ASSERT_THAT(moved(mesh, 4, below), HasNoIntersections());
  EXPECT_TRUE(is_ok(mesh, 4, below, 3));
}

TEST(PaperGuard, IsStuckInAPlaneWhereEdgesAndTrianglesAreTakenForMeeting) {
  // A move within the plane of a flat plate meets nothing.
  const TriangleMesh mesh = plate(4, 1);
  const Vec3 target(2.125, 2.25, 0.5);
  ASSERT_THAT(moved(mesh, kMiddle, target), HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, kMiddle, target, 2));
}

TEST(PaperGuard, MovesTheVertexThatItAccepted) {
  TriangleMesh mesh = noisy(icosphere(1), 0.05, 3);
  const TriangleMesh before = mesh;
  const VertexRings rings = build_rings(mesh).value();
  StarMove move(mesh, rings);
  PaperGuard guard(mesh, rings, 2);
  const VertexId v = 5;
  const Vec3 target = 0.98 * mesh.points[v];
  guard.enter({&v, 1}, nullptr);
  move.select(v);
  guard.select(move, target);
  move.aim(target);
  ASSERT_TRUE(guard.is_ok());
  EXPECT_TRUE(is_same(mesh, before)) << "asking moves nothing";
  guard.apply();
  EXPECT_TRUE(is_same(mesh, moved(before, v, target)));
}

TEST(PaperGuard, JudgesTheSelectedVertexWhereItsNeighboursAreBy) {
  // Select, move a neighbour, select again: the second answer is about the mesh as it is then.
  TriangleMesh mesh = noisy(icosphere(1), 0.05, 3);
  const VertexRings rings = build_rings(mesh).value();
  RandomPoints random(9);
  StarMove move(mesh, rings);
  PaperGuard guard(mesh, rings, 2);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const VertexId v = random.vertex_of(mesh);
    const Vec3 target = mesh.points[v] + 0.5 * random();
    guard.enter({&v, 1}, nullptr);
    move.select(v);
    guard.select(move, target);
    move.aim(target);
    const bool ok = guard.is_ok();
    ASSERT_EQ(ok, is_ok(mesh, v, target, 2)) << "move " << i << ", a fresh guard says so";
    if (ok) guard.apply();
    refused += static_cast<int>(!ok);
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace smopt
