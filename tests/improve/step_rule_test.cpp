#include "smopt/improve/step_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "smopt/mesh/rings.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << "(" << a.transpose() << ") and (" << b.transpose() << ")";
}

/// An apex at (1, 0, 2) over a ring in the plane z = 0: the square (±3, ±3), anticlockwise seen from above.
const std::vector<Vec3> kSquare = {{3, 3, 0}, {-3, 3, 0}, {-3, -3, 0}, {3, -3, 0}};
const std::vector<VertexId> kSquareRing = {0, 1, 2, 3};
const Vec3 kApex(1, 0, 2);

TEST(StepRule, UmbrellaGoesToTheMeanOfTheRing) {
  expect_near(proposed_step(StepRule::umbrella, kApex, kSquareRing, kSquare), {-1, 0, -2}, 1e-15);
  const std::vector<Vec3> points = {{9, 9, 9}, {1, 0, 0}, {0, 2, 0}, {0, 0, 4}};
  const std::vector<VertexId> ring = {1, 2, 3};
  expect_near(proposed_step(StepRule::umbrella, {1, 1, 1}, ring, points), {-2.0 / 3, -1.0 / 3, 1.0 / 3}, 1e-15);
}

TEST(StepRule, VolumePreservingLeavesOutThePartAlongTheAreaVector) {
  // The area vector of any star over the square is (0, 0, 72 / 2): the vertical part goes.
  expect_near(proposed_step(StepRule::volume_preserving, kApex, kSquareRing, kSquare), {-1, 0, 0}, 1e-15);
}

TEST(StepRule, TangentialIsOrthogonalToTheAngleWeightedNormal) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 3);
  const VertexRings rings = build_rings(mesh).value();
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < rings.valence(v); ++i) {
      const Vec3 p = mesh.points[rings.vertices(v)[i]] - mesh.points[v];
      const Vec3 q = mesh.points[rings.vertices(v)[(i + 1) % rings.valence(v)]] - mesh.points[v];
      normal += std::acos(p.dot(q) / (p.norm() * q.norm())) * p.cross(q).normalized();
    }
    const Vec3 step = proposed_step(StepRule::tangential, mesh.points[v], rings.vertices(v), mesh.points);
    const Vec3 whole = proposed_step(StepRule::umbrella, mesh.points[v], rings.vertices(v), mesh.points);
    EXPECT_NEAR(step.dot(normal.normalized()), 0, 1e-14) << "vertex " << v;
    expect_near(step, whole - whole.dot(normal.normalized()) * normal.normalized(), 1e-13);
  }
}

TEST(StepRule, VolumePreservingKeepsTheVolumeOneVertexAtATime) {
  TriangleMesh mesh = noisy(torus(1, 0.4, 20, 10), 0.08, 5);
  const VertexRings rings = build_rings(mesh).value();
  const double volume = enclosed_volume(mesh);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 step = proposed_step(StepRule::volume_preserving, mesh.points[v], rings.vertices(v), mesh.points);
    EXPECT_GT(step.norm(), 0);
    mesh.points[v] += step;
    ASSERT_NEAR(enclosed_volume(mesh) / volume, 1, 1e-12) << "vertex " << v;
  }
}

TEST(StepRule, DoesNotDependOnTheRingsFirstVertexOrOnWhereTheStarIs) {
  const std::vector<VertexId> turned = {2, 3, 0, 1};
  std::vector<Vec3> shifted = kSquare;
  const Vec3 shift(16, -32, 64);
  for (Vec3& p : shifted) p += shift;
  for (const StepRule rule : {StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential}) {
    const Vec3 step = proposed_step(rule, kApex, kSquareRing, kSquare);
    expect_near(proposed_step(rule, kApex, turned, kSquare), step, 1e-14);
    expect_near(proposed_step(rule, kApex + shift, kSquareRing, shifted), step, 1e-13);
  }
}

TEST(StepRule, IsFiniteOnDegenerateStars) {
  const std::vector<Vec3> line = {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}}, point = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  const std::vector<VertexId> ring = {0, 1, 2};
  for (const StepRule rule : {StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential}) {
    EXPECT_TRUE(proposed_step(rule, {0, 0, 0}, ring, line).allFinite());
    EXPECT_EQ(proposed_step(rule, {1, 1, 1}, ring, point), Vec3(0, 0, 0));
  }
}

}  // namespace
}  // namespace smopt
