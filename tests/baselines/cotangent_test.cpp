#include "baselines/cotangent.h"

#include <gmock/gmock.h>

#include "baselines/meshlab.h"
#include "smopt/error.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, const CotangentOptions& options) {
  smooth_cotangent(mesh, options);
  return mesh;
}

/// A square pyramid upside down whose lid has a vertex at `inner`: vertex 4; the tip is vertex 5.
TriangleMesh lidded_pyramid(const Vec3& inner) {
  return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, inner, {0, 0, -2}},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
}

TEST(Cotangent, StepOfATetrahedronByHand) {
  // All weights are the same: part of the way to the mean of the others, −p/3.
  const TriangleMesh after = smoothed(tetrahedron(), {1, 0.5});
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((after.points[v] - tetrahedron().points[v] / 3).norm(), 1e-15);
}

TEST(Cotangent, WeighsEdgesByTheAnglesThatFaceThem) {
  // A vertex at height h over the middle of the square: its edges all weigh the same, so that the whole way is to the middle. The corner
  // (−1, −1, 0) has the neighbours (1, −1, 0) and (−1, 1, 0) of the same weight a, the inner vertex of weight b and the tip of weight c.
  const double h = 1;
  const TriangleMesh after = smoothed(lidded_pyramid({0, 0, h}), {1, 1});
  EXPECT_LT(after.points[4].norm(), 1e-15);
  // Facing the edge to the next corner: the angle at the inner vertex, whose cotangent is cos/sin = (h²)/(2√(h² + 1)) for arms (±1, −1, −h),
  // and the one at the tip, whose arms are (±1, −1, 2). Facing the others: the base angles of those isosceles triangles.
  const double at_inner = h * h / (2 * std::sqrt(h * h + 1)), at_tip = 4 / (2 * std::sqrt(5.0));
  const double a = at_inner + at_tip, b = 2 / std::sqrt(h * h + 1), c = 2 / std::sqrt(5.0);  // base angle: half the base over the height
  const Vec3 expected = (a * Vec3(1, -1, 0) + a * Vec3(-1, 1, 0) + b * Vec3(0, 0, h) + c * Vec3(0, 0, -2)) / (2 * a + b + c);
  EXPECT_LT((after.points[0] - expected).norm(), 1e-15);
}

TEST(Cotangent, LeavesAVertexOfAPlaneWhereItIs) {
  const Vec3 inner(0.2, -0.3, 0);
  EXPECT_LT((smoothed(lidded_pyramid(inner), {1, 1}).points[4] - inner).norm(), 1e-15);
}

TEST(Cotangent, KeepsVerticesWithinTheirNeighboursBoxHoweverThinTheTriangles) {
  // Needles, caps and triangles of no area.
  for (const Vec3& inner : {Vec3(0.999999, 0, 0), Vec3(1, 0, 0), Vec3(1, -1, 0), Vec3(1 - 1e-9, -1 + 1e-12, 1e-11)}) {
    const TriangleMesh after = smoothed(lidded_pyramid(inner), {1, 1});
    for (const Vec3& p : after.points) {
      EXPECT_LE(p.cwiseAbs().maxCoeff(), 2.0);
      EXPECT_TRUE(p.allFinite());
    }
  }
}

TEST(Cotangent, NeverDivergesWhereMeshlabsWeightsDo) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.4, 1);  // edges of 0.14: folds and slivers
  TriangleMesh by_meshlab = mesh;
  EXPECT_NE(smooth_meshlab(by_meshlab, {200, MeshlabWeights::cotangent}), std::nullopt);
  for (const Vec3& p : smoothed(mesh, {200, 0.5}).points) EXPECT_LE(p.norm(), 1.4);
}

TEST(Cotangent, SaysWhenItDiverges) {
  // On a tetrahedron as uniform weights: beta 3 multiplies by −3, so that √3 · 3^k is beyond ten diagonals (34.6) for k = 3.
  TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(smooth_cotangent(mesh, {5, 3}), 3);
}

TEST(Cotangent, RejectsAnOpenMesh) {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.pop_back();
  EXPECT_THROW(smooth_cotangent(mesh, {}), InvalidMesh);
}

TEST(CotangentMethod, IsMeshlabsInFloat32) {
  const Method method = cotangent_method();
  TriangleMesh by_method = noisy(icosphere(1), 0.05, 1), by_hand = by_method;
  method.run(by_method, OptionValues(method.options, {{"rounds", "4"}, {"precision", "float32"}}), {});
  smooth_meshlab(by_hand, {4, MeshlabWeights::cotangent});
  EXPECT_EQ(by_method.points, by_hand.points);
}

TEST(CotangentMethod, PassesItsOptionsOn) {
  const Method method = cotangent_method();
  TriangleMesh by_method = noisy(icosphere(1), 0.05, 1);
  const TriangleMesh start = by_method;
  method.run(by_method, OptionValues(method.options, {{"rounds", "4"}, {"beta", "0.3"}}), {});
  EXPECT_EQ(by_method.points, smoothed(start, {4, 0.3}).points);
}

}  // namespace
}  // namespace smopt::baselines
