#include "smopt/surface/trilinear_block.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "smopt/surface/trilinear_surface.h"
#include "tests/support/matchers.h"
#include "tests/surface/mesh_shape.h"

namespace smopt {
namespace {

using testing::IsClosedManifold;
using testing::shape_of;

/// Random values at the inner nodes, -1 at the outermost.
ScalarGrid random_grid(std::array<std::uint32_t, 3> size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  ScalarGrid grid{size, Vec3(0.3, -2.2, 5.1), 0.745, {}, {-7, 3, 100}};
  for (std::size_t k = 0; k < size[2]; ++k) {
    for (std::size_t j = 0; j < size[1]; ++j) {
      for (std::size_t i = 0; i < size[0]; ++i) {
        const bool outermost = i == 0 || j == 0 || k == 0 || i + 1 == size[0] || j + 1 == size[1] || k + 1 == size[2];
        grid.values.push_back(outermost ? -1 : value(random));
      }
    }
  }
  return grid;
}

using Cell = std::array<std::uint32_t, 3>;

/// The block of the cells from `begin` to before `end`.
ScalarGrid part_of(const ScalarGrid& grid, const Cell& begin, const Cell& end) {
  ScalarGrid part{{}, grid.origin, grid.spacing, {}, grid.first};
  for (int axis = 0; axis < 3; ++axis) {
    part.size[axis] = end[axis] - begin[axis] + 1;
    part.first[axis] += static_cast<std::int32_t>(begin[axis]);
  }
  for (std::size_t k = begin[2]; k <= end[2]; ++k) {
    for (std::size_t j = begin[1]; j <= end[1]; ++j) {
      for (std::size_t i = begin[0]; i <= end[0]; ++i) part.values.push_back(grid.values[grid.index(i, j, k)]);
    }
  }
  return part;
}

/// Cuts an axis of so many cells at random.
std::vector<std::uint32_t> random_cuts(std::uint32_t cells, std::mt19937& random) {
  std::vector<std::uint32_t> cuts = {0, cells};
  for (int i = 0; i < 3; ++i) cuts.push_back(static_cast<std::uint32_t>(random()) % cells);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

std::vector<BlockMesh> meshed_in_parts(const ScalarGrid& grid, std::uint32_t seed, TrilinearSurfaceReport& report) {
  std::mt19937 random(seed);
  std::array<std::vector<std::uint32_t>, 3> cuts;
  for (int axis = 0; axis < 3; ++axis) cuts[axis] = random_cuts(grid.size[axis] - 1, random);
  std::vector<BlockMesh> blocks;
  for (std::size_t k = 0; k + 1 < cuts[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < cuts[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < cuts[0].size(); ++i) {
        const ScalarGrid part = part_of(grid, {cuts[0][i], cuts[1][j], cuts[2][k]}, {cuts[0][i + 1], cuts[1][j + 1], cuts[2][k + 1]});
        report += mesh_trilinear_block(part, 0, blocks.emplace_back());
      }
    }
  }
  return blocks;
}

TEST(TrilinearBlocks, JoinedAreTheMeshOfTheWholeGrid) {
  // Rows longer than a machine word, and of its length.
  for (const std::array<std::uint32_t, 3> size : {std::array{10U, 9U, 8U}, {65U, 6U, 7U}, {64U, 5U, 6U}, {150U, 5U, 6U}, {129U, 4U, 5U}}) {
    const ScalarGrid grid = random_grid(size, size[0]);
    TrilinearSurfaceReport whole;
    const TriangleMesh mesh = trilinear_surface(grid, 0, &whole);
    TrilinearSurfaceReport parts;
    const TriangleMesh of_parts = joined(meshed_in_parts(grid, 17, parts));
    EXPECT_THAT(of_parts, IsClosedManifold()) << size[0];
    EXPECT_EQ(shape_of(of_parts), shape_of(mesh)) << size[0];
    EXPECT_EQ(of_parts.vertex_count(), mesh.vertex_count()) << size[0];
    EXPECT_EQ(parts.surface_cells, whole.surface_cells) << size[0];
    EXPECT_EQ(parts.ambiguous_cells, whole.ambiguous_cells) << size[0];
    EXPECT_EQ(parts.tunnel_cells, whole.tunnel_cells) << size[0];
    EXPECT_EQ(parts.interior_vertices, whole.interior_vertices) << size[0];
  }
}

TEST(TrilinearBlocks, ShareTheVerticesInTheirOuterFacesOnly) {
  const ScalarGrid grid = random_grid({12, 11, 10}, 3);
  const ScalarGrid part = part_of(grid, {3, 2, 1}, {8, 9, 7});
  BlockMesh block;
  mesh_trilinear_block(part, 0, block);
  std::vector<char> is_shared(block.points.size());
  for (const auto& [edge, vertex] : block.shared) {
    ASSERT_EQ(is_shared[vertex], 0);
    is_shared[vertex] = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = grid.origin[axis] + grid.spacing * edge.node[axis];
      EXPECT_GE(block.points[vertex][axis], low);
      EXPECT_LE(block.points[vertex][axis], axis == edge.axis ? low + grid.spacing : low);
    }
  }
  for (std::size_t v = 0; v < block.points.size(); ++v) {
    bool is_outermost = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = block.points[v][axis];
      is_outermost = is_outermost || x == part.coordinate(axis, 0) || x == part.coordinate(axis, part.size[axis] - 1);
    }
    EXPECT_EQ(is_shared[v] != 0, is_outermost) << v;
  }
}

TEST(TrilinearBlocks, OfNoNodesAreEmpty) {
  BlockMesh block{{Vec3::Zero()}, {}, {}};
  mesh_trilinear_block({}, 0, block);
  EXPECT_TRUE(block.points.empty());
}

TEST(TrilinearBlocks, OfASingleLayerHaveVerticesButNoTriangles) {
  BlockMesh block;
  mesh_trilinear_block({{3, 1, 1}, Vec3::Zero(), 1, {-1, 1, -1}, {}}, 0, block);
  EXPECT_EQ(block.points.size(), 2U);
  EXPECT_EQ(block.shared.size(), 2U);
  EXPECT_TRUE(block.triangles.empty());
}

}  // namespace
}  // namespace smopt
