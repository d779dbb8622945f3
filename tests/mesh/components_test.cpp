#include "smopt/mesh/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::IsEmpty;

/// By the definition, in quadratic time: a triangle takes the lowest number among those it shares a vertex with, until nothing changes.
std::vector<std::uint32_t> lowest_connected_triangle(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> lowest(mesh.triangle_count());
  for (std::uint32_t f = 0; f < lowest.size(); ++f) lowest[f] = f;
  std::vector<std::uint32_t> of_vertex(mesh.vertex_count(), 0xFFFFFFFF);
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::uint32_t f = 0; f < lowest.size(); ++f) {
      for (const VertexId v : mesh.triangles[f]) {
        const std::uint32_t least = std::min(lowest[f], of_vertex[v]);
        is_changed = is_changed || lowest[f] != least || of_vertex[v] != least;
        lowest[f] = of_vertex[v] = least;
      }
    }
  }
  return lowest;
}

void expect_by_definition(const TriangleMesh& mesh) {
  const Components found = connected_components(mesh);
  const std::vector<std::uint32_t> lowest = lowest_connected_triangle(mesh);
  ASSERT_EQ(found.of_triangle.size(), mesh.triangle_count());
  std::vector<std::uint32_t> firsts = lowest;
  std::ranges::sort(firsts);
  firsts.erase(std::unique(firsts.begin(), firsts.end()), firsts.end());
  EXPECT_EQ(found.count, firsts.size());
  for (std::size_t f = 0; f < lowest.size(); ++f)
    ASSERT_EQ(found.of_triangle[f], std::ranges::lower_bound(firsts, lowest[f]) - firsts.begin()) << "triangle " << f;
  std::vector<std::uint32_t> of_vertex(mesh.vertex_count(), Components::kNone);
  for (std::size_t f = 0; f < lowest.size(); ++f)
    for (const VertexId v : mesh.triangles[f]) of_vertex[v] = found.of_triangle[f];
  EXPECT_EQ(found.of_vertex, of_vertex);
}

TEST(Components, AreNumberedByTheirFirstTriangle) {
  expect_by_definition(joined(joined(cube(), icosphere(2)), torus(3, 1, 10, 5)));
  for (std::uint32_t seed = 0; seed < 20; ++seed)
    expect_by_definition(relabelled(joined(joined(cube(), tetrahedron()), joined(icosphere(1), tetrahedron())), seed));
}

TEST(Components, OfRandomSoups) {
  std::mt19937 random(8);
  for (int i = 0; i < 100; ++i) {
    TriangleMesh soup{std::vector<Vec3>(60, Vec3::Zero()), {}};
    const auto vertex = [&] { return static_cast<VertexId>(random() % 60); };
    for (int k = 0; k < 5 + i % 30; ++k) soup.triangles.push_back({vertex(), vertex(), vertex()});
    expect_by_definition(soup);
  }
}

TEST(Components, OneSharedVertexConnects) {
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), {5, 0, 0}));
  EXPECT_EQ(connected_components(mesh).count, 2U);
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), 4U, 0U);
  EXPECT_EQ(connected_components(mesh).count, 1U);
}

TEST(Components, TheSamePlaceDoesNotConnect) {
  EXPECT_EQ(connected_components(joined(cube(), cube())).count, 2U);
}

TEST(Components, OfNothing) {
  EXPECT_EQ(connected_components({}).count, 0U);
  EXPECT_THAT(connected_components({}).of_triangle, IsEmpty());
  EXPECT_EQ(connected_components({{{0, 0, 0}}, {}}).count, 0U) << "a vertex without triangles is none";
}

}  // namespace
}  // namespace smopt
