#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <set>

#include "smopt/improve/improve.h"
#include "smopt/improve/sweep_schedule.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;

/// Several tiles of every colour, needles that have to be postponed, a component far away.
TriangleMesh many_tiles() {
  return joined(spiky(noisy(torus(10, 3, 240, 80), 0.05, 5), 97, 1.4), translated(noisy(icosphere(3), 0.05, 6), {1000, 0, 0}));
}

TriangleMesh improved_with_threads(std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  TriangleMesh mesh = many_tiles();
  improve(mesh, {});
  return mesh;
}

TEST(Threads, GiveTheSameBytesWhateverTheirNumber) {
  const TriangleMesh one = improved_with_threads(1);
  EXPECT_FALSE(is_same(one, many_tiles()));
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(is_same(improved_with_threads(threads), one)) << threads << " threads";
}

TEST(Threads, CreateNoIntersection) {
  const TriangleMesh before = many_tiles(), after = improved_with_threads(8);
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_LE(intersecting_pairs(after).size(), intersecting_pairs(before).size());
}

/// Large enough for large tiles.
TriangleMesh large_mesh() {
  return noisy(torus(10, 3, 820, 500), 0.005, 5);
}

TEST(Threads, GiveTheSameBytesOnALargeMesh) {
  const auto smoothed_with = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    TriangleMesh mesh = large_mesh();
    SmoothingOptions options;
    options.rounds = 2;
    smooth(mesh, options);
    return mesh;
  };
  const TriangleMesh one = smoothed_with(1);
  EXPECT_FALSE(is_same(one, large_mesh()));
  EXPECT_TRUE(is_same(smoothed_with(3), one));
}

class SweepSchedules : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SmallAndLargeTiles, SweepSchedules, ::testing::Bool());

TEST_P(SweepSchedules, VisitEveryVertexOnceAndKeepRegionsOfAColourApart) {
  const TriangleMesh mesh = GetParam() ? large_mesh() : many_tiles();
  const TriangleGrid grid(mesh.points, mesh.triangles);
  std::vector<VertexId> some;
  for (VertexId v = 0; v < mesh.vertex_count(); v += 3) some.push_back(v);
  const SweepSchedule schedule(grid, mesh, some);
  std::multiset<VertexId> visited;
  for (int color = 0; color < SweepSchedule::kColors; ++color) {
    const auto tiles = schedule.tiles(color);
    EXPECT_GT(tiles.size(), 1U);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      for (const std::span<const VertexId> group : tiles[i].groups) {
        EXPECT_TRUE(std::is_sorted(group.begin(), group.end()));
        visited.insert(group.begin(), group.end());
        for (const VertexId v : group) EXPECT_TRUE(tiles[i].region.contains(grid.cubes_of(grid.box_of(mesh.points[v], mesh.points[v]))));
      }
      for (std::size_t j = 0; j < i; ++j) {
        bool is_apart = false;
        for (int axis = 0; axis < 3; ++axis)
          is_apart |= tiles[i].region.high[axis] < tiles[j].region.low[axis] || tiles[j].region.high[axis] < tiles[i].region.low[axis];
        EXPECT_TRUE(is_apart) << "colour " << color << ", tiles " << i << " and " << j;
      }
    }
  }
  EXPECT_EQ(visited, std::multiset<VertexId>(some.begin(), some.end()));
}

}  // namespace
}  // namespace smopt
