#include "metrics/intersections.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <random>
#include <variant>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Pair = std::pair<FaceId, FaceId>;

std::size_t count(const TriangleMesh& mesh) {
  return find_intersections(mesh).count.value();
}

TriangleMesh soup(std::vector<Vec3> points, std::vector<Triangle> triangles) {
  return {std::move(points), std::move(triangles)};
}

/// The definition taken at its word, all with all: the common part of two triangles is constructed with exact numbers, and whatever of it
/// is not in the convex hull of the shared vertices (a point or an edge) makes a pair.
class BruteForce {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Point = Kernel::Point_3;

 public:
  explicit BruteForce(const TriangleMesh& mesh) : mesh_(mesh) {
    for (const Vec3& p : mesh.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  std::vector<Pair> pairs() const {
    std::vector<Pair> found;
    for (FaceId f = 0; f < mesh_.triangle_count(); ++f)
      for (FaceId g = f + 1; g < mesh_.triangle_count(); ++g)
        if (!triangle(f).is_degenerate() && !triangle(g).is_degenerate() && meet_elsewhere(f, g)) found.emplace_back(f, g);
    return found;
  }

 private:
  Kernel::Triangle_3 triangle(FaceId f) const {
    const auto& [a, b, c] = mesh_.triangles[f];
    return {points_[a], points_[b], points_[c]};
  }

  bool meet_elsewhere(FaceId f, FaceId g) const {
    const auto common = CGAL::intersection(triangle(f), triangle(g));
    if (!common) return false;
    std::vector<Point> shared;
    for (const VertexId v : mesh_.triangles[f])
      if (std::count(mesh_.triangles[g].begin(), mesh_.triangles[g].end(), v) != 0) shared.push_back(points_[v]);
    if (shared.size() == 3) return true;
    for (const Point& p : corners_of(*common))
      if (!is_in_hull(p, shared)) return true;
    return false;
  }

  template <class Common>
  static std::vector<Point> corners_of(const Common& common) {
    if (const auto* p = boost::get<Point>(&common)) return {*p};
    if (const auto* s = boost::get<Kernel::Segment_3>(&common)) return {s->source(), s->target()};
    if (const auto* t = boost::get<Kernel::Triangle_3>(&common)) return {t->vertex(0), t->vertex(1), t->vertex(2)};
    return boost::get<std::vector<Point>>(common);
  }

  static bool is_in_hull(const Point& p, const std::vector<Point>& shared) {
    if (shared.empty()) return false;
    return shared.size() == 1 ? p == shared[0] : Kernel::Segment_3(shared[0], shared[1]).has_on(p);
  }

  const TriangleMesh& mesh_;
  std::vector<Point> points_;
};

TEST(Intersections, CleanMeshesHaveNone) {
  for (const TriangleMesh& mesh : {tetrahedron(), cube(), icosphere(3), torus(3, 1, 24, 16)}) EXPECT_EQ(count(mesh), 0U);
  EXPECT_EQ(count({}), 0U);
}

TEST(Intersections, OneTriangleThroughAnother) {
  const TriangleMesh mesh = soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {5, 5, 1}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_THAT(find_intersections(mesh).pairs, ElementsAre(Pair(0, 1)));
}

TEST(Intersections, TouchingWithoutASharedIndexCounts) {
  const TriangleMesh corner_on_face = soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(count(corner_on_face), 1U);
  const TriangleMesh same_place_other_index =
      soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(count(same_place_other_index), 1U);
}

TEST(Intersections, SharedVertexAloneDoesNotCountButMeetingBesideItDoes) {
  EXPECT_EQ(count(soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}})), 0U);
  EXPECT_EQ(count(soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}}, {{0, 1, 2}, {0, 3, 4}})), 1U) << "pierced";
  EXPECT_EQ(count(soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, 0}, {2, 1, 0}}, {{0, 1, 2}, {0, 3, 4}})), 1U)
      << "one inside the other, in a plane";
  EXPECT_EQ(count(soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8, 0, 0}, {8, 0, 3}}, {{0, 1, 2}, {0, 3, 4}})), 1U) << "a side along a side";
}

TEST(Intersections, SharedEdgeAloneDoesNotCountButFoldingOverDoes) {
  EXPECT_EQ(count(soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}})), 0U) << "flat";
  EXPECT_EQ(count(soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}}, {{0, 1, 2}, {1, 0, 3}})), 0U) << "a sharp fold is not yet flat";
  EXPECT_EQ(count(soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}})), 1U) << "folded over";
}

TEST(Intersections, TwoFacesOnTheSameVerticesAreOnePair) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({2, 0, 1});
  EXPECT_THAT(find_intersections(mesh).pairs, ElementsAre(Pair(0, 4)));
  mesh.triangles.push_back({0, 2, 1});
  EXPECT_EQ(count(mesh), 3U) << "three faces: three pairs, whichever way they run";
}

TEST(Intersections, DegenerateFacesBelongToNoPairAndHideNone) {
  TriangleMesh mesh = soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {5, 5, 1}, {1, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  mesh.triangles.push_back({3, 4, 6});  // corners on a line through triangle 0
  mesh.triangles.push_back({3, 3, 4});
  mesh.triangles.push_back({3, 4, 6});
  EXPECT_THAT(find_intersections(mesh).pairs, ElementsAre(Pair(0, 1)));
}

TEST(Intersections, CrossingTetrahedraAgreeWithAHandCount) {
  // The second one is the mirror image of the first: each of its six edges crosses an edge of the first in a face centre of the cube.
  const TriangleMesh mesh = joined(tetrahedron(), reversed(scaled(tetrahedron(), -1)));
  const std::vector<Pair> expected = BruteForce(mesh).pairs();
  EXPECT_EQ(find_intersections(mesh).pairs, expected);
  // Opposite faces (parallel) do not meet, the other three of each do: 4 · 3.
  EXPECT_EQ(expected.size(), 12U);
}

TEST(Intersections, AgreeWithExactBruteForceOnRandomMeshes) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = noisy(icosphere(1), 0.6, seed);
    const std::vector<Pair> expected = BruteForce(mesh).pairs();
    EXPECT_THAT(expected, ::testing::Not(IsEmpty()));
    EXPECT_EQ(find_intersections(mesh).pairs, expected);
  }
}

TEST(Intersections, AgreeWithExactBruteForceOnDegenerateLattices) {
  // Triangles between few lattice points: everything is coplanar, collinear, shared or doubled somewhere.
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    TriangleMesh mesh;
    for (int i = 0; i < 27; ++i) mesh.points.emplace_back(i % 3, (i / 3) % 3, i / 9);
    for (int i = 0; i < 60; ++i) mesh.triangles.push_back({VertexId(random() % 27), VertexId(random() % 27), VertexId(random() % 27)});
    const std::vector<Pair> expected = BruteForce(mesh).pairs();
    EXPECT_GT(expected.size(), 100U);
    EXPECT_EQ(find_intersections(mesh).pairs, expected);
  }
}

TEST(Intersections, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = noisy(icosphere(5), 0.1, 1);
  const auto with_all = find_intersections(mesh).pairs;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_GT(with_all.size(), 10U);
  EXPECT_EQ(find_intersections(mesh).pairs, with_all);
}

TEST(Intersections, CountDoesNotChangeWithNumberingOrTheLimitOfTheList) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.2, 5);
  const Intersections all = find_intersections(mesh);
  EXPECT_EQ(count(relabelled(mesh, 9)), *all.count);
  const Intersections few = find_intersections(mesh, {.list_limit = 3});
  EXPECT_EQ(few.count, all.count);
  EXPECT_THAT(few.pairs, ElementsAre(all.pairs[0], all.pairs[1], all.pairs[2]));
}

TEST(Intersections, AreNotCountedBeyondTheLimitAndThatIsSaid) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.2, 5);
  const std::size_t all = count(mesh);
  EXPECT_EQ(find_intersections(mesh, {.count_limit = all}).count, all);
  const Intersections stopped = find_intersections(mesh, {.count_limit = all - 1});
  EXPECT_FALSE(stopped.count.has_value());
  EXPECT_TRUE(stopped.pairs.empty());
  EXPECT_EQ(stopped.why_not_counted, "more than " + std::to_string(all - 1) + " pairs");
}

TEST(Intersections, DoNotExistWhereACornerIsNotFinite) {
  TriangleMesh mesh = cube();
  mesh.points.emplace_back(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_EQ(count(mesh), 0U) << "a point in no triangle does not matter";
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_FALSE(find_intersections(mesh).count.has_value());
  EXPECT_EQ(find_intersections(mesh).why_not_counted, "a triangle has a corner that is not finite");
}

}  // namespace
}  // namespace smopt::metrics
