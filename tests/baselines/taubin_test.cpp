#include "baselines/taubin.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "baselines/laplacian.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

/// A closed polygon: triangles with a repeated corner, so that each vertex has two neighbours.
TriangleMesh circle(VertexId n) {
  TriangleMesh mesh;
  for (VertexId v = 0; v < n; ++v) {
    mesh.points.emplace_back(0, 0, 0);
    mesh.triangles.push_back({v, (v + 1) % n, v});
  }
  return mesh;
}

TEST(Taubin, StepsOfATetrahedronByHand) {
  // The mean of the other three is −p/3, so that a step of weight w multiplies by 1 − 4w/3: 1/3 for 0.5, then 1.8 for −0.6.
  TriangleMesh mesh = tetrahedron();
  smooth_taubin(mesh, {1, 0.5, -0.6});
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((mesh.points[v] - 0.6 * tetrahedron().points[v]).norm(), 1e-15);
}

TEST(Taubin, HasItsTransferFunctionOnACircleOfVertices) {
  // The wave of j periods on n vertices is an eigenvector of I − mean with k = 1 − cos(2πj/n); a round multiplies it by (1 − λk)(1 − μk).
  constexpr VertexId n = 24;
  constexpr int kRounds = 7;
  const TaubinOptions options{kRounds, 0.6307, -0.6732};
  for (int j = 0; j <= 12; ++j) {
    TriangleMesh mesh = circle(n);
    const auto wave = [&](VertexId v) { return std::cos(2 * std::numbers::pi * j * v / n); };
    for (VertexId v = 0; v < n; ++v) mesh.points[v] = wave(v) * Vec3(1, -2, 3);
    smooth_taubin(mesh, options);
    const double k = 1 - std::cos(2 * std::numbers::pi * j / n);
    const double factor = std::pow((1 - options.lambda * k) * (1 - options.mu * k), kRounds);
    for (VertexId v = 0; v < n; ++v) EXPECT_LT((mesh.points[v] - factor * wave(v) * Vec3(1, -2, 3)).norm(), 1e-12) << j << " periods";
  }
}

TEST(Taubin, PassesLowFrequenciesAndStopsHighOnes) {
  // Between 0 and 1/λ + 1/μ the factor is at least 1, above it falls.
  TriangleMesh smooth = circle(96), rough = circle(96);
  for (VertexId v = 0; v < 96; ++v) {
    smooth.points[v] = Vec3(std::cos(2 * std::numbers::pi * v / 96), 0, 0);
    rough.points[v] = Vec3(v % 2 == 0 ? 1 : -1, 0, 0);
  }
  smooth_taubin(smooth, {});
  smooth_taubin(rough, {});
  EXPECT_GT(smooth.points[0].x(), 1);
  EXPECT_LT(smooth.points[0].x(), 1.02);
  EXPECT_LT(std::abs(rough.points[0].x()), 1e-20);
}

TEST(Taubin, ChangesTheVolumeFarLessThanLaplacianSmoothing) {
  const TriangleMesh before = icosphere(3);
  TriangleMesh after = before, plain = before;
  smooth_taubin(after, {});
  smooth_laplacian(plain, {200, 0.5, SweepOrder::jacobi});  // as many steps
  const auto change = [&](const TriangleMesh& mesh) { return std::abs(enclosed_volume(mesh) - enclosed_volume(before)); };
  EXPECT_LT(change(after), 0.15 * change(plain));
}

TEST(Taubin, SaysWhenItDiverges) {
  // 1 − 4λ/3 = −3 with λ = 3, and 1 − 4μ/3 = 1 with μ = 0: threefold a round; ten diagonals of the box are 34.6, the corners at √3 · 3^k.
  TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(smooth_taubin(mesh, {5, 3, 0}), 3);
}

TEST(TaubinMethod, PassesItsOptionsOn) {
  const Method method = taubin_method();
  TriangleMesh by_method = noisy(icosphere(1), 0.1, 1), by_hand = by_method;
  const MethodReport report =
      method.run(by_method, OptionValues(method.options, {{"rounds", "4"}, {"lambda", "0.3"}, {"mu", "-0.35"}}), {});
  smooth_taubin(by_hand, {4, 0.3, -0.35});
  EXPECT_EQ(by_method.points, by_hand.points);
  EXPECT_EQ(report.rounds_run, 4U);
  EXPECT_EQ(report.stopped_because, "rounds");
}

}  // namespace
}  // namespace smopt::baselines
