#include "baselines/cgal/shape_smoothing.h"

#include <gtest/gtest.h>

#include "smopt/error.h"
#include "tests/baselines/cgal/shapes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, const ShapeOptions& options) {
  EXPECT_EQ(smooth_shape(mesh, options), options.rounds);
  return mesh;
}

TEST(ShapeSmoothing, KeepsTheVolumeAndLessensTheArea) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.03, 5);
  const TriangleMesh after = smoothed(mesh, {5, 0.01});
  EXPECT_NEAR(enclosed_volume(after), enclosed_volume(mesh), 1e-9);
  EXPECT_LT(surface_area(after), 0.99 * surface_area(mesh));
  EXPECT_EQ(after.triangles, mesh.triangles);
}

TEST(ShapeSmoothing, LeavesASphereASphere) {
  const TriangleMesh after = smoothed(icosphere(3, 2.0), {10, 0.1});
  for (const Vec3& p : after.points) EXPECT_NEAR(p.norm(), 2.0, 0.02);
}

TEST(ShapeSmoothing, MakesACubeRounder) {
  const auto roundness = [](const TriangleMesh& m) { return std::pow(surface_area(m), 3) / std::pow(enclosed_volume(m), 2); };
  const TriangleMesh after = smoothed(cube(), {3, 0.05});
  EXPECT_LT(roundness(after), roundness(cube()));
}

TEST(ShapeSmoothing, MovesLittleInALittleTime) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.03, 5);
  const auto moved = [&](double time) { return farthest(smoothed(mesh, {1, time}).points, mesh.points); };
  EXPECT_GT(moved(1e-6), 0.0);
  EXPECT_NEAR(moved(2e-6) / moved(1e-6), 2.0, 0.01);  // in proportion as the time goes to 0
}

TEST(ShapeSmoothing, OneCallIsNotOneCallARoundAsTheStiffnessIsTheInitialMeshs) {
  TriangleMesh one_by_one = noisy(icosphere(2), 0.03, 5);
  for (int round = 0; round < 3; ++round) one_by_one = smoothed(one_by_one, {1, 0.01});
  EXPECT_GT(farthest(one_by_one.points, smoothed(noisy(icosphere(2), 0.03, 5), {3, 0.01}).points), 1e-6);
}

TEST(ShapeMethod, PassesItsOptionsOnAndRejectsNoTime) {
  const Method method = shape_method();
  const TriangleMesh mesh = noisy(icosphere(2), 0.03, 5);
  const auto by_method = [&](const std::map<std::string, std::string>& given) {
    TriangleMesh copy = mesh;
    method.run(copy, OptionValues(method.options, given), {});
    return copy.points;
  };
  EXPECT_EQ(by_method({}), smoothed(mesh, {10, 1e-4}).points);
  EXPECT_EQ(by_method({{"rounds", "2"}, {"time", "0.01"}}), smoothed(mesh, {2, 0.01}).points);
  EXPECT_THROW(by_method({{"time", "0"}}), InvalidOption);
  EXPECT_THROW(by_method({{"time", "-1"}}), InvalidOption);
}

}  // namespace
}  // namespace smopt::baselines
