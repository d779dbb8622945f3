#include "smopt/surface/block_mesh.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/support/matchers.h"
#include "tests/support/shapes.h"
#include "tests/surface/mesh_shape.h"

namespace smopt {
namespace {

using ::testing::ElementsAre;
using testing::IsClosedManifold;
using testing::shape_of;

GridEdge edge_with_number(std::int32_t number) {
  return {{number % 7, number / 7, -number}, number % 3};
}

/// Deals the triangles of a mesh out to blocks at random; every vertex is shared, on an edge of its own, and numbered anew in each block.
std::vector<BlockMesh> dealt_out(const TriangleMesh& mesh, std::size_t blocks, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<BlockMesh> dealt(blocks);
  std::vector<std::map<VertexId, VertexId>> numbers(blocks);
  for (const Triangle& triangle : mesh.triangles) {
    const std::size_t b = random() % blocks;
    Triangle& copy = dealt[b].triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [number, is_new] = numbers[b].try_emplace(triangle[i], static_cast<VertexId>(dealt[b].points.size()));
      if (is_new) {
        dealt[b].points.push_back(mesh.points[triangle[i]]);
        dealt[b].shared.push_back({edge_with_number(static_cast<std::int32_t>(triangle[i])), number->second});
      }
      copy[i] = number->second;
    }
  }
  for (BlockMesh& block : dealt) std::shuffle(block.shared.begin(), block.shared.end(), random);
  return dealt;
}

TEST(JoinedBlocks, MakeTheMeshAgainThatWasDealtOut) {
  const TriangleMesh sphere = testing::icosphere(3);
  for (const std::size_t blocks : {1, 2, 5, 40}) {
    const TriangleMesh mesh = joined(dealt_out(sphere, blocks, 7));
    EXPECT_EQ(mesh.vertex_count(), sphere.vertex_count()) << blocks;
    EXPECT_THAT(mesh, IsClosedManifold()) << blocks;
    EXPECT_EQ(shape_of(mesh), shape_of(sphere)) << blocks;
  }
}

TEST(JoinedBlocks, NumberVerticesAndTrianglesBlockAfterBlock) {
  const GridEdge left{{-3, 2, 5}, 0};
  const GridEdge right{{-3, 2, 5}, 1};
  BlockMesh first{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}, {{right, 1}}};
  BlockMesh second{{Vec3(1, 0, 0), Vec3(5, 5, 5), Vec3(2, 0, 0)}, {{2, 1, 0}}, {{left, 2}, {right, 0}}};
  BlockMesh third{{Vec3(2, 0, 0), Vec3(7, 7, 7), Vec3(1, 0, 0)}, {{0, 1, 2}}, {{right, 2}, {left, 0}}};
  const TriangleMesh mesh = joined({first, second, third});
  EXPECT_THAT(mesh.points, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5), Vec3(2, 0, 0), Vec3(7, 7, 7)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{4, 3, 1}, Triangle{4, 5, 1}));
}

TEST(JoinedBlocks, KeepVerticesApartThatAreAtOnePlaceButNotShared) {
  const BlockMesh block{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}, {}};
  EXPECT_EQ(joined({block, block}).vertex_count(), 6U);
}

TEST(JoinedBlocks, OfNothingAreNothing) {
  EXPECT_EQ(joined({}).vertex_count(), 0U);
  EXPECT_EQ(joined({BlockMesh{}, BlockMesh{}}).triangle_count(), 0U);
}

TEST(JoinedBlocks, AreTheSameForAnyNumberOfThreads) {
  const std::vector<BlockMesh> blocks = dealt_out(testing::icosphere(5), 300, 11);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return joined(blocks);
  };
  const TriangleMesh one = with_threads(1);
  for (const std::size_t threads : {2, 3, 8}) {
    const TriangleMesh mesh = with_threads(threads);
    EXPECT_EQ(mesh.points, one.points) << threads;
    EXPECT_EQ(mesh.triangles, one.triangles) << threads;
  }
}

}  // namespace
}  // namespace smopt
