#include "metrics/dihedral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

/// Two triangles at the edge from (0, 0, 0) to (2, 0, 0), so many degrees apart; their apexes are not at the same place along it.
TriangleMesh hinge(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  return {{{0, 0, 0}, {2, 0, 0}, {0.5, 1, 0}, {1.7, 3 * std::cos(angle), 3 * std::sin(angle)}}, {{0, 1, 2}, {1, 0, 3}}};
}

TEST(Dihedral, OfACubeIs90AndOfATetrahedronTheArcCosineOfAThird) {
  EXPECT_NEAR(smallest_dihedral_deg(cube()).value(), 90, 1e-12);
  EXPECT_NEAR(smallest_dihedral_deg(tetrahedron()).value(), std::acos(1.0 / 3) * 180 / std::numbers::pi, 1e-12);
}

TEST(Dihedral, IsZeroForFoldedAnd180ForFlatAndAlikeInwardsAndOutwards) {
  for (const double angle : {0.0, 1e-6, 0.05, 30.0, 90.0, 150.0, 180.0}) {
    EXPECT_NEAR(smallest_dihedral_deg(hinge(angle)).value(), angle, 1e-10);
    EXPECT_NEAR(smallest_dihedral_deg(hinge(-angle)).value(), angle, 1e-10);
  }
}

TEST(Dihedral, IsTheSmallestOfAllAndFindsTheOneFold) {
  EXPECT_NEAR(smallest_dihedral_deg(joined(icosphere(3), translated(hinge(0.01), {5, 0, 0}))).value(), 0.01, 1e-10);
  EXPECT_GT(smallest_dihedral_deg(icosphere(3)).value(), 165) << "a finely divided sphere is nearly flat everywhere";
}

TEST(Dihedral, DependsNeitherOnTheSizeNorOnTheSideNorOnTheOrder) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 7);
  const double expected = smallest_dihedral_deg(mesh).value();
  EXPECT_NEAR(smallest_dihedral_deg(scaled(mesh, 1e-9)).value(), expected, 1e-9);
  EXPECT_NEAR(smallest_dihedral_deg(reversed(mesh)).value(), expected, 1e-9);
  EXPECT_NEAR(smallest_dihedral_deg(rotated(relabelled(mesh, 3), {1, 2, 3}, 0.7)).value(), expected, 1e-9);
}

TEST(Dihedral, OfATriangleWithoutAnAreaIsZero) {
  TriangleMesh mesh = hinge(90);
  mesh.points[2] = {1, 0, 0};
  EXPECT_EQ(smallest_dihedral_deg(mesh).value(), 0);
}

TEST(Dihedral, DoesNotExistWithoutAnEdgeOfTwoTrianglesOrWithoutFiniteCorners) {
  EXPECT_FALSE(smallest_dihedral_deg({}));
  EXPECT_FALSE(smallest_dihedral_deg({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  TriangleMesh mesh = cube();
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(smallest_dihedral_deg(mesh));
}

}  // namespace
}  // namespace smopt::metrics
