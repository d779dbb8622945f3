#include "smopt/surface/trilinear_surface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/surface/self_intersections.h"
#include "tests/surface/subdivided_field.h"

namespace smopt {
namespace {

using testing::count_self_intersections;
using ::testing::HasSubstr;
using testing::IsClosedManifold;
using ::testing::ThrowsMessage;

/// Values by `value(random)` at inner³ nodes, in a margin of -1.
template <class Value>
ScalarGrid random_grid(std::uint32_t inner, std::uint32_t seed, Value value) {
  std::mt19937 random(seed);
  const std::uint32_t n = inner + 2;
  ScalarGrid grid{{n, n, n}, Vec3(-1.3, 0.4, 2.7), 0.745, {}};
  grid.values.assign(grid.node_count(), -1.0);
  for (std::uint32_t k = 1; k <= inner; ++k) {
    for (std::uint32_t j = 1; j <= inner; ++j) {
      for (std::uint32_t i = 1; i <= inner; ++i) grid.values[grid.index(i, j, k)] = value(random);
    }
  }
  return grid;
}

double uniform(std::mt19937& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

double small_integer(std::mt19937& random) {
  return std::uniform_int_distribution<int>(-2, 2)(random);
}

/// Inside and outside alternate from node to node but for one in eight: nearly all faces are ambiguous.
ScalarGrid checkerboard_grid(std::uint32_t inner, std::uint32_t seed) {
  ScalarGrid grid = random_grid(inner, seed, uniform);
  std::mt19937 random(seed);
  for (std::uint32_t k = 1; k <= inner; ++k) {
    for (std::uint32_t j = 1; j <= inner; ++j) {
      for (std::uint32_t i = 1; i <= inner; ++i) {
        double& value = grid.values[grid.index(i, j, k)];
        if (random() % 8 != 0) value = std::copysign(value, (i + j + k) % 2 == 0 ? 1 : -1);
      }
    }
  }
  return grid;
}

int component_count(const TriangleMesh& mesh) {
  std::vector<VertexId> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](VertexId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  int count = static_cast<int>(parent.size());
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 2; ++i) {
      const VertexId a = root(t[i]);
      const VertexId b = root(t[i + 1]);
      if (a == b) continue;
      parent[a] = b;
      --count;
    }
  }
  return count;
}

void expect_sound(const ScalarGrid& grid, const TriangleMesh& mesh, std::uint32_t seed) {
  EXPECT_THAT(mesh, IsClosedManifold()) << "seed " << seed;
  EXPECT_EQ(count_self_intersections(mesh), 0U) << "seed " << seed;
  std::size_t crossed_edges = 0;
  const auto count = [&](std::size_t node, std::size_t next) { crossed_edges += (grid.values[node] >= 0) != (grid.values[next] >= 0); };
  for (std::size_t k = 0; k + 1 < grid.size[2]; ++k) {
    for (std::size_t j = 0; j + 1 < grid.size[1]; ++j) {
      for (std::size_t i = 0; i + 1 < grid.size[0]; ++i) {
        const std::size_t node = grid.index(i, j, k);
        count(node, grid.index(i + 1, j, k));
        count(node, grid.index(i, j + 1, k));
        count(node, grid.index(i, j, k + 1));
      }
    }
  }
  TrilinearSurfaceReport report;
  trilinear_surface(grid, 0, &report);
  EXPECT_EQ(mesh.vertex_count(), crossed_edges + report.interior_vertices) << "seed " << seed;
}

TEST(TrilinearSurface, OfRandomValuesIsAClosedManifoldWithoutIntersections) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const ScalarGrid grid = random_grid(10, seed, uniform);
    expect_sound(grid, trilinear_surface(grid, 0), seed);
  }
}

TEST(TrilinearSurface, OfTiedValuesIsAClosedManifoldWithoutIntersections) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const ScalarGrid grid = random_grid(10, seed, small_integer);
    expect_sound(grid, trilinear_surface(grid, 0), seed);
  }
}

TEST(TrilinearSurface, OfACheckerboardIsAClosedManifoldWithoutIntersections) {
  std::size_t tunnels = 0;
  std::size_t interior = 0;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const ScalarGrid grid = checkerboard_grid(9, seed);
    TrilinearSurfaceReport report;
    expect_sound(grid, trilinear_surface(grid, 0, &report), seed);
    EXPECT_LE(report.ambiguous_cells, report.surface_cells);
    tunnels += report.tunnel_cells;
    interior += report.interior_vertices;
  }
  EXPECT_GT(tunnels, 5U);
  EXPECT_GT(interior, 100U);
}

TEST(TrilinearSurface, HasTheTopologyOfTheSubdividedField) {
  int compared = 0;
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const ScalarGrid grid = random_grid(2, seed, uniform);
    const testing::SubdividedField fine(grid, 16);
    const testing::SubdividedField coarser(grid, 11);
    const int chi = fine.euler_characteristic_of_level_set();
    const int pieces = fine.inside_components() + fine.outside_components() - 1;
    if (coarser.euler_characteristic_of_level_set() != chi || coarser.inside_components() + coarser.outside_components() - 1 != pieces)
      continue;
    const TriangleMesh mesh = trilinear_surface(grid, 0);
    EXPECT_EQ(testing::euler_characteristic(mesh), chi) << "seed " << seed;
    EXPECT_EQ(component_count(mesh), pieces) << "seed " << seed;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(TrilinearSurface, IsTheSameForAnIsovalueAsForAShiftedField) {
  ScalarGrid grid = random_grid(6, 3, small_integer);
  const TriangleMesh mesh = trilinear_surface(grid, 0);
  for (double& v : grid.values) v += 5;
  const TriangleMesh shifted = trilinear_surface(grid, 5);
  EXPECT_EQ(mesh.points, shifted.points);
  EXPECT_EQ(mesh.triangles, shifted.triangles);
}

TEST(TrilinearSurface, AroundOneInsideNodeIsAnOctahedronOrientedOutwards) {
  ScalarGrid grid = random_grid(1, 1, [](std::mt19937&) { return 1.0; });
  const TriangleMesh mesh = trilinear_surface(grid, 0);
  EXPECT_EQ(mesh.vertex_count(), 6U);
  EXPECT_EQ(mesh.triangle_count(), 8U);
  const double half_axis = 0.745 / 2;
  EXPECT_NEAR(testing::enclosed_volume(mesh), 4.0 / 3 * half_axis * half_axis * half_axis, 1e-12);
}

TEST(TrilinearSurface, AroundANodeThatIsExactlyAtTheLevelIsTinyAndSound) {
  ScalarGrid grid = random_grid(1, 1, [](std::mt19937&) { return 0.0; });
  const TriangleMesh mesh = trilinear_surface(grid, 0);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(count_self_intersections(mesh), 0U);
  EXPECT_GT(testing::enclosed_volume(mesh), 0);
}

TEST(TrilinearSurface, OfAFieldThatIsOutsideEverywhereIsEmpty) {
  const TriangleMesh mesh = trilinear_surface(random_grid(2, 1, [](std::mt19937&) { return -1.0; }), 0);
  EXPECT_EQ(mesh.vertex_count(), 0U);
  EXPECT_EQ(mesh.triangle_count(), 0U);
}

TEST(TrilinearSurface, RefusesGridsItCannotMesh) {
  ScalarGrid open = random_grid(2, 1, uniform);
  open.values[open.index(0, 1, 2)] = 1;
  EXPECT_THAT([&] { trilinear_surface(open, 0); }, ThrowsMessage<InvalidInput>(HasSubstr("outermost node (0, 1, 2)")));
  ScalarGrid not_a_number = random_grid(2, 1, uniform);
  not_a_number.values[not_a_number.index(1, 2, 1)] = std::nan("");
  EXPECT_THAT([&] { trilinear_surface(not_a_number, 0); }, ThrowsMessage<InvalidInput>(HasSubstr("node (1, 2, 1) is not finite")));
  ScalarGrid far_away = random_grid(2, 1, uniform);
  far_away.origin.x() = 1e12;
  EXPECT_THAT([&] { trilinear_surface(far_away, 0); }, ThrowsMessage<InvalidInput>(HasSubstr("cannot be resolved")));
  ScalarGrid short_of_values = random_grid(2, 1, uniform);
  short_of_values.values.pop_back();
  EXPECT_THROW(trilinear_surface(short_of_values, 0), InvalidInput);
}

TEST(TrilinearSurface, StopsWhenTheCallbackSaysSo) {
  EXPECT_THROW(trilinear_surface(random_grid(2, 1, uniform), 0, nullptr, [](auto, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace smopt
