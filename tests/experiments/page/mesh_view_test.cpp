#include "experiments/page/mesh_view.h"

#include <gmock/gmock.h>

#include <bit>
#include <limits>

#include "metrics/intersections.h"
#include "tests/experiments/page/unpacked_words.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using testing::icosphere;
using testing::joined;
using testing::translated;

/// Two balls that overlap: triangles intersect along a circle.
TriangleMesh overlapping_balls() {
  return joined(icosphere(3), translated(icosphere(3), Vec3(1.2, 0.03, 0.05)));
}

TEST(MeshView, HoldsTheMeshInSinglePrecisionRelativeToTheCentre) {
  const TriangleMesh mesh = translated(icosphere(2), Vec3(1e4, -2e4, 5));
  const Vec3 centre(1e4, -2e4, 5);
  const MeshView view = mesh_view(mesh, {centre}, false);
  const std::vector<std::uint32_t> positions = testing::unpacked_words(view.positions, 3);
  ASSERT_EQ(positions.size(), 3 * mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(std::bit_cast<float>(positions[3 * v + axis]), static_cast<float>((mesh.points[v] - centre)[static_cast<int>(axis)]));
  const std::vector<std::uint32_t> indices = testing::unpacked_words(view.indices, 1);
  ASSERT_EQ(indices.size(), 3 * mesh.triangle_count());
  for (std::size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(indices[i], mesh.triangles[i / 3][i % 3]);
}

TEST(MeshView, ListsThePairsThatTheJudgeFinds) {
  const TriangleMesh mesh = overlapping_balls();
  const metrics::Intersections found = metrics::find_intersections(mesh);
  ASSERT_GT(found.pairs.size(), 0U);
  const nlohmann::ordered_json pairs = mesh_view(mesh, {}, true).facts.at("pairs");
  EXPECT_EQ(pairs.at("count"), found.pairs.size());
  ASSERT_EQ(pairs.at("listed").size(), std::min(found.pairs.size(), kListedPairs));
  for (std::size_t i = 0; i < pairs.at("listed").size(); ++i) {
    EXPECT_EQ(pairs.at("listed")[i][2], found.pairs[i].first);
    EXPECT_EQ(pairs.at("listed")[i][3], found.pairs[i].second);
  }
}

TEST(MeshView, OfAPartListsThePairsOfTheWholeMeshThatLieInIt) {
  const TriangleMesh mesh = overlapping_balls();
  const metrics::Intersections found = metrics::find_intersections(mesh);
  const Ball ball = ball_around(mesh, mesh.points[mesh.triangles[found.pairs[0].first][0]], 150);
  const ShownPart part = shown_part(mesh, ball);
  std::vector<std::pair<FaceId, FaceId>> inside;
  for (const auto& [f, g] : found.pairs)
    if (std::ranges::binary_search(part.faces, f) && std::ranges::binary_search(part.faces, g)) inside.emplace_back(f, g);
  ASSERT_GT(inside.size(), 0U);
  ASSERT_LT(inside.size(), found.pairs.size());

  const nlohmann::ordered_json facts = mesh_view(mesh, ball, true).facts;
  EXPECT_EQ(facts.at("triangles"), mesh.triangle_count());
  EXPECT_EQ(facts.at("shown_triangles"), 150);
  EXPECT_EQ(facts.at("pairs").at("count"), inside.size());
  for (const auto& pair : facts.at("pairs").at("listed")) {
    EXPECT_EQ(part.faces[pair[0].get<std::size_t>()], pair[2].get<FaceId>());
    EXPECT_EQ(part.faces[pair[1].get<std::size_t>()], pair[3].get<FaceId>());
  }
}

TEST(MeshView, ListsTheWorstTrianglesByWhereTheyAreShown) {
  const TriangleMesh mesh = testing::noisy(icosphere(3), 0.03, 5);
  const Ball ball = ball_around(mesh, mesh.points[0], 300);
  const ShownPart part = shown_part(mesh, ball);
  const nlohmann::ordered_json worst = mesh_view(mesh, ball, false).facts.at("worst");
  ASSERT_EQ(worst.size(), 3U);
  for (const auto& [measure, list] : worst.items()) {
    ASSERT_EQ(list.size(), kListedTriangles) << measure;
    for (const auto& entry : list) EXPECT_EQ(part.faces[entry[0].get<std::size_t>()], entry[1].get<FaceId>());
  }
}

TEST(MeshView, IsAroundTheFirstIntersectingPair) {
  const TriangleMesh mesh = overlapping_balls();
  const auto [f, g] = metrics::find_intersections(mesh).pairs.at(0);
  const Ball ball = ball_to_show(mesh, 100, true);
  const ShownPart part = shown_part(mesh, ball);
  EXPECT_TRUE(std::ranges::binary_search(part.faces, f));
  EXPECT_TRUE(std::ranges::binary_search(part.faces, g));
}

TEST(MeshView, IsAroundTheSmallestAngleWhereNothingIntersects) {
  TriangleMesh mesh = icosphere(3);
  const Triangle thin = mesh.triangles[200];
  mesh.points[thin[0]] = 0.99 * mesh.points[thin[1]] + 0.01 * mesh.points[thin[0]];
  const ShownPart part = shown_part(mesh, ball_to_show(mesh, 50, false));
  EXPECT_TRUE(std::ranges::any_of(part.faces, [&](FaceId face) { return std::ranges::count(mesh.triangles[face], thin[1]) > 0; }));
}

TEST(MeshView, OfACornerThatIsNotFiniteHoldsTheRest) {
  TriangleMesh mesh = overlapping_balls();
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::ordered_json facts = mesh_view(mesh, ball_to_show(mesh, kShownTriangles, true), true).facts;
  EXPECT_GT(facts.at("undrawable_triangles"), 0);
  EXPECT_GT(facts.at("pairs").at("count"), 0);
}

}  // namespace
}  // namespace smopt::experiments
