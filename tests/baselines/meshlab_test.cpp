// Against MeshLab itself: tests/baselines/external.
#include "baselines/meshlab.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, int rounds, MeshlabWeights weights) {
  smooth_meshlab(mesh, {rounds, weights});
  return mesh;
}

TEST(Meshlab, UniformStepOfATetrahedronByHand) {
  // Each neighbour counts twice, and the others sum to −p: (p − 2p) / (1 + 6).
  const TriangleMesh after = smoothed(tetrahedron(), 1, MeshlabWeights::uniform);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((after.points[v] + tetrahedron().points[v] / 7).norm(), 1e-7);
}

TEST(Meshlab, CotangentStepOfATetrahedronByHand) {
  // All weights are 2 cot 60° = 2/√3: p (1 − 2/√3) / (1 + 2√3).
  const double factor = (1 - 2 / std::sqrt(3.0)) / (1 + 2 * std::sqrt(3.0));
  const TriangleMesh after = smoothed(tetrahedron(), 1, MeshlabWeights::cotangent);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((after.points[v] - factor * tetrahedron().points[v]).norm(), 1e-7);
}

TEST(Meshlab, ComputesInFloat32) {
  for (const MeshlabWeights weights : {MeshlabWeights::uniform, MeshlabWeights::cotangent}) {
    for (const Vec3& p : smoothed(noisy(icosphere(1), 0.1, 1), 3, weights).points) EXPECT_EQ(p, p.cast<float>().cast<double>());
  }
}

TEST(Meshlab, SaysTheFirstStepThatDiverged) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.4, 1);
  TriangleMesh all = mesh;
  const std::optional<int> step = smooth_meshlab(all, {200, MeshlabWeights::cotangent});
  ASSERT_TRUE(step);
  TriangleMesh until = mesh;
  EXPECT_EQ(smooth_meshlab(until, {*step - 1, MeshlabWeights::cotangent}), std::nullopt);
  EXPECT_EQ(smooth_meshlab(until = mesh, {*step, MeshlabWeights::cotangent}), step);
  TriangleMesh uniform = mesh;
  EXPECT_EQ(smooth_meshlab(uniform, {200, MeshlabWeights::uniform}), std::nullopt);
}

TEST(MeshlabMethod, ReportsTheStepThatDivergedAndRunsOn) {
  const Method method = meshlab_method();
  TriangleMesh mesh = noisy(icosphere(3), 0.4, 1);
  const MethodReport report = method.run(mesh, OptionValues(method.options, {{"rounds", "200"}}), {});
  ASSERT_TRUE(report.diverged_at_step);
  EXPECT_EQ(report.stopped_because, "diverged at step " + std::to_string(*report.diverged_at_step));
  EXPECT_EQ(report.rounds_run, 200U);
}

TEST(MeshlabMethod, HasMeshlabsDefaults) {
  const Method method = meshlab_method();
  TriangleMesh by_default = noisy(icosphere(1), 0.05, 1);
  const TriangleMesh start = by_default;
  method.run(by_default, OptionValues(method.options, {}), {});
  EXPECT_EQ(by_default.points, smoothed(start, 3, MeshlabWeights::cotangent).points);
}

}  // namespace
}  // namespace smopt::baselines
