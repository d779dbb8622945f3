#include "smopt/improve/screening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;

bool is_low(const TriangleMesh& mesh, const Triangle& t, const QualityThresholds& thresholds) {
  const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  return edge_ratio(a, b, c) < thresholds.edge_ratio || smallest_angle_deg(a, b, c) < thresholds.min_angle_deg;
}

/// The corners of the low triangles for which `is_looked_at`, and every vertex joined to one of them by an edge.
template <class Predicate>
ActiveSet by_brute_force(const TriangleMesh& mesh, const QualityThresholds& thresholds, const Predicate& is_looked_at) {
  ActiveSet result;
  std::set<VertexId> corners;
  for (const Triangle& t : mesh.triangles) {
    if (!is_looked_at(t) || !is_low(mesh, t, thresholds)) continue;
    ++result.low_quality;
    corners.insert(t.begin(), t.end());
  }
  std::set<VertexId> active = corners;
  for (const Triangle& t : mesh.triangles)
    if (std::any_of(t.begin(), t.end(), [&](VertexId v) { return corners.contains(v); })) active.insert(t.begin(), t.end());
  result.vertices.assign(active.begin(), active.end());
  return result;
}

TEST(Screening, FindsWhatBruteForceFinds) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const TriangleMesh mesh = relabelled(noisy(spiky(icosphere(2), 11, 1.6), 0.12, seed), seed);
    const VertexRings rings = build_rings(mesh).value();
    for (const QualityThresholds& thresholds : {QualityThresholds{0.1, 10}, QualityThresholds{0.5, 0}, QualityThresholds{0, 30},
                                                QualityThresholds{0.7, 45}, QualityThresholds{0, 0}}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << thresholds.edge_ratio << ", " << thresholds.min_angle_deg);
      const ActiveSet expected = by_brute_force(mesh, thresholds, [](const Triangle&) { return true; });
      Screening screening(mesh, rings, thresholds);
      for (int repeat = 0; repeat < 2; ++repeat) {
        const ActiveSet found = screening.of_all();
        EXPECT_EQ(found.low_quality, expected.low_quality);
        EXPECT_EQ(found.vertices, expected.vertices);
      }
    }
  }
}

TEST(Screening, LooksOnlyAroundTheGivenVertices) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.12, 4);
  const VertexRings rings = build_rings(mesh).value();
  const QualityThresholds thresholds{0.4, 30};
  std::vector<VertexId> given(mesh.vertex_count() / 3);
  std::iota(given.begin(), given.end(), 20U);
  const ActiveSet expected = by_brute_force(mesh, thresholds, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](VertexId v) { return std::binary_search(given.begin(), given.end(), v); });
  });
  Screening screening(mesh, rings, thresholds);
  const ActiveSet found = screening.of_stars(given);
  EXPECT_GT(expected.low_quality, 0U);
  EXPECT_LT(found.low_quality, screening.of_all().low_quality);
  EXPECT_EQ(found.low_quality, expected.low_quality);
  EXPECT_EQ(found.vertices, expected.vertices);
}

TEST(Screening, FollowsTheMeshAsItMoves) {
  TriangleMesh mesh = icosphere(2);
  const VertexRings rings = build_rings(mesh).value();
  Screening screening(mesh, rings, {0.1, 10});
  EXPECT_TRUE(screening.of_all().vertices.empty());
  mesh.points[50] = 0.99 * mesh.points[rings.vertices(50)[0]] + 0.01 * mesh.points[50];
  const ActiveSet found = screening.of_stars({50});
  EXPECT_GT(found.low_quality, 0U);
  EXPECT_TRUE(std::binary_search(found.vertices.begin(), found.vertices.end(), 50U));
}

TEST(Screening, CountsADegenerateTriangleAsLow) {
  TriangleMesh mesh = icosphere(1);
  const VertexRings rings = build_rings(mesh).value();
  mesh.points[0] = mesh.points[rings.vertices(0)[0]];
  EXPECT_GE(Screening(mesh, rings, {0.1, 0}).of_all().low_quality, 2U);
  EXPECT_GE(Screening(mesh, rings, {0, 10}).of_all().low_quality, 2U);
}

}  // namespace
}  // namespace smopt
