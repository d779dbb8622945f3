#include "metrics/vertex_spacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

/// Every pair of vertices.
double slow_spacing(const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 low = mesh.points[0], high = low;
  for (const Vec3& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (mesh.points[i] - mesh.points[j]).norm());
  return least / (high - low).norm();
}

TEST(VertexSpacing, OfACubeIsItsEdgeOverItsDiagonal) {
  EXPECT_NEAR(smallest_vertex_spacing(cube()).value(), 1 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(smallest_vertex_spacing(scaled(cube(), 1e-7)).value(), 1 / std::sqrt(3.0), 1e-12);
}

TEST(VertexSpacing, IsZeroForTwoVerticesAtOnePlace) {
  TriangleMesh mesh = icosphere(3);
  mesh.points.push_back(mesh.points[17]);
  EXPECT_EQ(smallest_vertex_spacing(mesh).value(), 0) << "in no triangle, and counts";
  EXPECT_EQ(smallest_vertex_spacing({{{1, 2, 3}, {1, 2, 3}}, {}}).value(), 0) << "a box without a diagonal";
}

TEST(VertexSpacing, SeesVerticesThatAreNoNeighbours) {
  // Two cubes whose faces are 1e-6 apart.
  const TriangleMesh mesh = joined(cube(), translated(cube(), {1 + 1e-6, 0, 0}));
  EXPECT_NEAR(smallest_vertex_spacing(mesh).value(), 1e-6 / std::sqrt(2.0 + 4.0), 1e-12);
}

TEST(VertexSpacing, AgreesWithEveryPairHeldAgainstEveryOther) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const TriangleMesh mesh = noisy(icosphere(2), 0.3, seed);
    EXPECT_NEAR(smallest_vertex_spacing(mesh).value(), slow_spacing(mesh), 1e-15) << "seed " << seed;
  }
}

TEST(VertexSpacing, DoesNotExistForOneVertexOrOneThatIsNotFinite) {
  EXPECT_FALSE(smallest_vertex_spacing({}));
  EXPECT_FALSE(smallest_vertex_spacing({{{0, 0, 0}}, {}}));
  TriangleMesh mesh = cube();
  mesh.points[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(smallest_vertex_spacing(mesh));
}

}  // namespace
}  // namespace smopt::metrics
