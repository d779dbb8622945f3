#include "baselines/hc.h"

#include <gmock/gmock.h>

#include "baselines/laplacian.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, const HcOptions& options) {
  smooth_hc(mesh, options);
  return mesh;
}

/// The factor by which a regular tetrahedron that is `size` times its original becomes smaller in one round, by hand: the mean of the other
/// three is −1/3 of a vertex, whatever it is a mean of.
double tetrahedron_after_round(double size, double alpha, double beta) {
  const double push = -size / 3 - (alpha + (1 - alpha) * size);
  return -size / 3 - (beta * push + (1 - beta) * (-push / 3));
}

TEST(Hc, RoundsOfATetrahedronByHand) {
  for (const double alpha : {0.0, 0.4, 1.0}) {
    for (const double beta : {0.0, 0.5, 0.8}) {
      const double once = tetrahedron_after_round(1, alpha, beta), twice = tetrahedron_after_round(once, alpha, beta);
      const TriangleMesh one = smoothed(tetrahedron(), {1, alpha, beta}), two = smoothed(tetrahedron(), {2, alpha, beta});
      for (std::size_t v = 0; v < 4; ++v) {
        EXPECT_LT((one.points[v] - once * tetrahedron().points[v]).norm(), 1e-15);
        EXPECT_LT((two.points[v] - twice * tetrahedron().points[v]).norm(), 1e-15);
      }
    }
  }
  EXPECT_DOUBLE_EQ(tetrahedron_after_round(1, 0, 0.5), 1.0 / 9);  // −1/3 − (½ · −4/3 + ½ · 4/9)
}

TEST(Hc, DependsOnTheOriginalPositionsThroughAlpha) {
  // Two rounds from the original are two single rounds, each with its own start as the original, only where the original does not count.
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 5);
  const auto restarted = [&](double alpha) { return smoothed(smoothed(mesh, {1, alpha, 0.5}), {1, alpha, 0.5}).points; };
  EXPECT_EQ(smoothed(mesh, {2, 0, 0.5}).points, restarted(0));
  EXPECT_GT((smoothed(mesh, {2, 0.5, 0.5}).points[0] - restarted(0.5)[0]).norm(), 1e-4);
}

TEST(Hc, IsPulledToTheOriginalTheMoreTheLargerAlphaIs) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.05, 5);
  const auto distance = [&](double alpha) {
    const TriangleMesh after = smoothed(mesh, {50, alpha, 0.5});
    double sum = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) sum += (after.points[v] - mesh.points[v]).squaredNorm();
    return sum;
  };
  EXPECT_LT(distance(1), distance(0.5));
  EXPECT_LT(distance(0.5), distance(0));
}

TEST(Hc, MovesNothingWhenEachVertexTakesItsOwnPushBackInFull) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 5), after = smoothed(mesh, {3, 0.7, 1});
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_LT((after.points[v] - mesh.points[v]).norm(), 1e-15);
}

TEST(Hc, LosesLessVolumeThanLaplacianSmoothing) {
  TriangleMesh plain = icosphere(3);
  smooth_laplacian(plain, {20, 1, SweepOrder::jacobi});
  const double whole = enclosed_volume(icosphere(3));
  EXPECT_LT(whole - enclosed_volume(smoothed(icosphere(3), {20, 0, 0.5})), 0.2 * (whole - enclosed_volume(plain)));
}

TEST(HcMethod, PassesItsOptionsOn) {
  const Method method = hc_method();
  TriangleMesh by_method = noisy(icosphere(1), 0.1, 1);
  const TriangleMesh start = by_method;
  method.run(by_method, OptionValues(method.options, {{"rounds", "4"}, {"alpha", "0.3"}, {"beta", "0.7"}}), {});
  EXPECT_EQ(by_method.points, smoothed(start, {4, 0.3, 0.7}).points);
}

}  // namespace
}  // namespace smopt::baselines
