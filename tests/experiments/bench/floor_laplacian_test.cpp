#include "experiments/bench/floor_laplacian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "baselines/laplacian.h"
#include "tests/support/shapes.h"

namespace smopt::bench {
namespace {

using namespace smopt::testing;
using Loop = FloorLaplacian::Loop;

/// Two tips of valence n over a ring of n vertices of valence 4.
TriangleMesh bipyramid(VertexId n) {
  TriangleMesh mesh;
  for (VertexId i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0.1 * (i % 3));
  }
  mesh.points.emplace_back(0.1, 0.2, 1);
  mesh.points.emplace_back(0.2, 0.1, -1);
  for (VertexId i = 0; i < n; ++i) {
    mesh.triangles.push_back({i, (i + 1) % n, n});
    mesh.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  return mesh;
}

/// Every valence from 3 to 24, also in the last vertices of the mesh.
TriangleMesh mesh_of_all_valences() {
  TriangleMesh mesh = joined(noisy(icosphere(3), 0.05, 1), tetrahedron());
  for (VertexId n = 24; n >= 5; --n) mesh = joined(mesh, bipyramid(n));
  return mesh;
}

class FloorLaplacianOf : public ::testing::TestWithParam<Loop> {};

TEST_P(FloorLaplacianOf, AgreesWithTheBaselineForEveryValence) {
  constexpr int kRounds = 20;
  for (const TriangleMesh& mesh : {mesh_of_all_valences(), tetrahedron()}) {
    TriangleMesh expected = mesh;
    baselines::smooth_laplacian(expected, {kRounds, 1, baselines::SweepOrder::jacobi});
    FloorLaplacian floor(mesh);
    floor.run(kRounds, GetParam());
    // Positions of size 1, rounded once a neighbour and round at most.
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_LT((floor.points()[v] - expected.points[v]).norm(), 1e-13) << "vertex " << v;
  }
}

TEST_P(FloorLaplacianOf, StartsAnewAfterReset) {
  const TriangleMesh mesh = mesh_of_all_valences();
  FloorLaplacian floor(mesh);
  floor.run(3, GetParam());
  const std::vector<Vec3> once = floor.points();
  floor.reset(mesh);
  floor.run(3, GetParam());
  EXPECT_EQ(floor.points(), once);
}

INSTANTIATE_TEST_SUITE_P(Loops, FloorLaplacianOf, ::testing::Values(Loop::branchless, Loop::straightforward),
                         [](const auto& loop) { return loop.param == Loop::branchless ? "branchless" : "straightforward"; });

}  // namespace
}  // namespace smopt::bench
