#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

#include "baselines/iso2mesh/resample.h"
#include "smopt/error.h"
#include "smopt/io/off.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

constexpr CollapsePlacement kPlacements[] = {CollapsePlacement::midpoint, CollapsePlacement::lindstrom_turk};

TriangleMesh resampled(TriangleMesh mesh, const ResampleOptions& options) {
  resample(mesh, options);
  return mesh;
}

ResampleOptions exact(std::size_t vertices, CollapsePlacement placement = CollapsePlacement::midpoint) {
  return {.vertices = vertices, .placement = placement, .digits = 0};
}

/// 2 components, one with a hole through it: 800 + 642 vertices, Euler characteristic 2.
TriangleMesh test_mesh() {
  return joined(noisy(torus(3, 1, 40, 20), 0.02, 7), translated(noisy(icosphere(3), 0.01, 8), Vec3(7, 0, 0)));
}

std::vector<Vec3> sorted(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec3& p, const Vec3& q) { return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end()); });
  return points;
}

/// What a text with six significant digits gives back.
double through_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

TEST(Resample, ReplacesTheShortestEdgeByItsMidpoint) {
  // A pyramid on its apex with a square roof, and in the roof a vertex 0.5 away from the corner (1, 1, 0) and farther from all others.
  TriangleMesh mesh{{{0.7, 0.6, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, -2}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}}};
  const ResampleReport report = resample(mesh, {.vertices = 5});
  EXPECT_EQ(sorted(mesh.points), (std::vector<Vec3>{{-1, -1, 0}, {-1, 1, 0}, {0, 0, -2}, {0.85, 0.8, 0}, {1, -1, 0}}));
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(mesh.triangle_count(), 6U);
  EXPECT_EQ(report.vertices_before, 6U);
  EXPECT_EQ(report.vertices_after, 5U);
  EXPECT_TRUE(report.is_target_met);
}

TEST(Resample, TakesTheShortestEdgeAndNotTheOneThatChangesTheSurfaceLeast) {
  // The same pyramid with its apex near a corner of the roof: the vertex in the middle of the roof could go without a change.
  TriangleMesh mesh{{{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, -0.5}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}}};
  const TriangleMesh least = resampled(mesh, exact(5, CollapsePlacement::lindstrom_turk));
  EXPECT_NEAR(enclosed_volume(least), enclosed_volume(mesh), 1e-12);
  resample(mesh, {.vertices = 5});
  EXPECT_EQ(sorted(mesh.points), (std::vector<Vec3>{{-1, -1, 0}, {-1, 1, 0}, {0, 0, 0}, {1, -1, 0}, {1, 1, -0.25}}));
}

TEST(Resample, MeetsTheNumberOfVerticesExactlyOnAClosedSurface) {
  for (const CollapsePlacement placement : kPlacements) {
    for (const std::size_t target : {1441U, 1000U, 123U}) {
      TriangleMesh mesh = test_mesh();
      const ResampleReport report = resample(mesh, exact(target, placement));
      EXPECT_EQ(mesh.vertex_count(), target);
      EXPECT_EQ(report.vertices_after, target);
      EXPECT_TRUE(report.is_target_met);
    }
  }
}

TEST(Resample, KeepsTheTopologyAndTheOrientation) {
  for (const CollapsePlacement placement : kPlacements) {
    const TriangleMesh after = resampled(test_mesh(), exact(200, placement));
    EXPECT_THAT(after, IsClosedManifold());
    EXPECT_EQ(euler_characteristic(after), 2);
    EXPECT_NEAR(enclosed_volume(after), enclosed_volume(test_mesh()), 0.2 * enclosed_volume(test_mesh()));
  }
}

TEST(Resample, LindstromAndTurkKeepTheVolumeAndMidpointsDoNot) {
  const TriangleMesh mesh = icosphere(3);
  const auto change = [&](CollapsePlacement placement) {
    return enclosed_volume(resampled(mesh, exact(300, placement))) / enclosed_volume(mesh) - 1;
  };
  EXPECT_NEAR(change(CollapsePlacement::lindstrom_turk), 0, 1e-6);
  EXPECT_LT(change(CollapsePlacement::midpoint), -0.01);
}

TEST(Resample, LeavesATetrahedronWhateverIsAskedFor) {
  for (const CollapsePlacement placement : kPlacements) {
    TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), Vec3(5, 0, 0)));
    const ResampleReport report = resample(mesh, exact(4, placement));
    EXPECT_EQ(mesh.points, joined(tetrahedron(), translated(tetrahedron(), Vec3(5, 0, 0))).points);
    EXPECT_FALSE(report.is_target_met);
  }
}

TEST(Resample, StopsWhereEachComponentIsAsSmallAsItsTopologyAllows) {
  const TriangleMesh after = resampled(joined(icosphere(2), translated(icosphere(1), Vec3(5, 0, 0))), exact(1));
  EXPECT_EQ(after.vertex_count(), 8U);  // two tetrahedra
  EXPECT_THAT(after, IsClosedManifold());
}

TEST(Resample, DoesNothingWhereThereAreNoMoreVerticesThanWanted) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 3);
  for (const std::size_t target : {42U, 43U, 1000U}) {
    TriangleMesh copy = mesh;
    const ResampleReport report = resample(copy, {.vertices = target});
    EXPECT_EQ(copy.points, mesh.points);
    EXPECT_EQ(copy.triangles, mesh.triangles);
    EXPECT_EQ(report.vertices_after, 42U);
    EXPECT_EQ(report.is_target_met, target == 42);
  }
}

TEST(Resample, RoundsPositionsToSixDigitsUnlessToldOtherwise) {
  const TriangleMesh unrounded = resampled(test_mesh(), exact(1000));
  const TriangleMesh six = resampled(test_mesh(), {.vertices = 1000});
  const TriangleMesh three = resampled(test_mesh(), {.vertices = 1000, .digits = 3});
  ASSERT_EQ(six.vertex_count(), 1000U);
  for (std::size_t v = 0; v < 1000; ++v) {
    EXPECT_EQ(six.points[v], Vec3(unrounded.points[v].unaryExpr(&through_text)));
    EXPECT_LT((three.points[v] - unrounded.points[v]).cwiseAbs().maxCoeff(), 0.006);  // coordinates below 10
    EXPECT_NE(three.points[v], six.points[v]);
  }
}

TEST(Resample, MergesVerticesThatRoundingMakesEqual) {
  // The corner (1, 1, 1) of the first and one of the second are 1e-9 apart; nothing can be collapsed.
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), Vec3(2 + 1e-9, 2, 0)));
  const ResampleReport report = resample(mesh, {.vertices = 7});
  EXPECT_EQ(report.merged_vertices, 1U);
  EXPECT_EQ(report.vertices_after, 7U);
  EXPECT_TRUE(report.is_target_met);
  ASSERT_EQ(mesh.vertex_count(), 7U);
  EXPECT_EQ(std::count(mesh.points.begin(), mesh.points.end(), Vec3(1, 1, 1)), 1);
  EXPECT_EQ(mesh.triangle_count(), 8U);
  EXPECT_NEAR(enclosed_volume(mesh), 2 * enclosed_volume(tetrahedron()), 1e-4);
}

TEST(Resample, LeavesTheFacesThatMergingMakesEqual) {
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), Vec3(1e-9, 0, 0)));
  const ResampleReport report = resample(mesh, {.vertices = 5});
  EXPECT_EQ(report.merged_vertices, 4U);
  EXPECT_EQ(mesh.points, tetrahedron().points);
  EXPECT_EQ(mesh.triangles.size(), 8U);
  std::set<Triangle> different;
  for (Triangle t : mesh.triangles) {
    std::sort(t.begin(), t.end());
    different.insert(t);
  }
  EXPECT_EQ(different.size(), 4U);
}

TEST(Resample, MergesNegativeZeroWithZero) {
  const TriangleMesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  TriangleMesh negative = corner;
  for (Vec3& p : negative.points) p = p.unaryExpr([](double x) { return x == 0 ? -0.0 : x; });
  TriangleMesh mesh = joined(negative, corner);
  EXPECT_EQ(resample(mesh, {.vertices = 4}).merged_vertices, 4U);
  for (const Vec3& p : mesh.points) EXPECT_FALSE(std::signbit(p.minCoeff()));
}

TEST(Resample, NeitherRoundsNorMergesWithZeroDigits) {
  TriangleMesh mesh = joined(tetrahedron(), tetrahedron());
  EXPECT_EQ(resample(mesh, exact(4)).merged_vertices, 0U);
  EXPECT_EQ(mesh.vertex_count(), 8U);
}

TEST(Resample, LeavesTheBorderOfAnOpenSurface) {
  TriangleMesh mesh = noisy(icosphere(3), 0.01, 2);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.points[t[0]].z() < 0; });
  std::vector<char> is_used(mesh.vertex_count(), 0);
  std::multiset<std::pair<VertexId, VertexId>> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(std::minmax(t[k], t[(k + 1) % 3]));
    for (const VertexId v : t) is_used[v] = 1;
  }
  const auto isolated = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), 0));
  const std::size_t target = isolated + 150;
  const TriangleMesh after = resampled(mesh, exact(target));
  EXPECT_EQ(after.vertex_count(), target);
  for (const auto& [v, w] : edges) {
    if (edges.count({v, w}) != 1) continue;
    EXPECT_TRUE(std::find(after.points.begin(), after.points.end(), mesh.points[v]) != after.points.end());
    EXPECT_TRUE(std::find(after.points.begin(), after.points.end(), mesh.points[w]) != after.points.end());
  }
}

TEST(Resample, GoesWithRigidMotionsAndScaling) {
  for (const CollapsePlacement placement : kPlacements) {
    const auto mapped = [](const TriangleMesh& mesh) { return scaled(translated(rotated(mesh, Vec3(1, 2, 3), 0.7), Vec3(4, -5, 6)), 3.0); };
    const std::vector<Vec3> here = mapped(resampled(test_mesh(), exact(700, placement))).points;
    const std::vector<Vec3> there = resampled(mapped(test_mesh()), exact(700, placement)).points;
    ASSERT_EQ(here.size(), there.size());
    double far = 0;
    for (std::size_t v = 0; v < here.size(); ++v) far = std::max(far, (here[v] - there[v]).norm());
    EXPECT_LT(far, placement == CollapsePlacement::midpoint ? 1e-10 : 1e-5);  // Lindstrom and Turk solve badly conditioned equations
  }
}

TEST(Resample, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const CollapsePlacement placement : kPlacements)
    expect_same_for_any_threads([&] { return format_off(resampled(test_mesh(), {.vertices = 500, .placement = placement}), {}); });
}

TEST(Resample, RefusesWhatIsNoManifoldOrNotFinite) {
  TriangleMesh pinched = joined(icosphere(1), translated(icosphere(1), Vec3(5, 0, 0)));
  for (Triangle& t : pinched.triangles)
    for (VertexId& v : t) v = v == 42 ? 0 : v;
  EXPECT_THROW(resample(pinched, {.vertices = 10}), InvalidMesh);

  TriangleMesh infinite = icosphere(1);
  infinite.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(resample(infinite, {.vertices = 10}), InvalidMesh);
}

TEST(Resample, RejectsDigitsThatADoubleDoesNotHave) {
  for (const int digits : {-1, 18}) {
    TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(resample(mesh, {.vertices = 10, .digits = digits}), InvalidOption);
  }
}

TEST(Resample, StopsWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = icosphere(4);
  int calls = 0;
  EXPECT_THROW(resample(mesh, {.vertices = 10}, [&](std::string_view, double) { return ++calls < 2; }), Cancelled);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace smopt::baselines
