#include "baselines/cgal/cgal_methods.h"

#include <gmock/gmock.h>

#include "baselines/cgal/angle_area_smoothing.h"
#include "smopt/error.h"
#include "smopt/io/off.h"
#include "tests/baselines/cgal/shapes.h"
#include "tests/baselines/method_run.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using Given = std::map<std::string, std::string>;

const MethodRegistry& registry() {
  static const MethodRegistry methods = [] {
    MethodRegistry made;
    register_cgal_methods(made);
    return made;
  }();
  return methods;
}

MethodResult run(const std::string& name, TriangleMesh mesh, const Given& given = {}, const ProgressCallback& progress = {}) {
  return run_method(registry().find(name), std::move(mesh), given, progress);
}

/// Two components, one of them with a hole through it; noise that no method meets by symmetry.
TriangleMesh test_mesh() {
  return joined(noisy(torus(3, 1, 24, 12), 0.05, 7), translated(noisy(icosphere(2), 0.05, 8), Vec3(7, 0, 0)));
}

std::vector<std::string> built_methods() {
  std::vector<std::string> names = {"cgal_angle", "cgal_remesh", "cgal_tangential", "cgal_shape"};
  if (has_area_smoothing()) names.emplace_back("cgal_area");
  return names;
}

/// Methods that move the vertices they are given, rather than making others.
std::vector<std::string> smoothing_methods() {
  std::vector<std::string> names = built_methods();
  std::erase(names, "cgal_remesh");
  return names;
}

std::string as_test_name(const ::testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class CgalMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, CgalMethod, ::testing::ValuesIn(built_methods()), as_test_name);

class CgalSmoothing : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, CgalSmoothing, ::testing::ValuesIn(smoothing_methods()), as_test_name);

TEST(CgalMethods, AreInTheRegistryWithASourceANoteAndHelpForEveryOption) {
  for (const char* name : {"cgal_angle", "cgal_area", "cgal_remesh", "cgal_tangential", "cgal_shape"}) {
    const Method& method = registry().find(name);
    EXPECT_THAT(method.source, ::testing::HasSubstr("CGAL 5.5")) << name;
    EXPECT_FALSE(method.note.empty()) << name;
    EXPECT_FALSE(method.options.empty()) << name;
    for (const MethodOption& option : method.options) EXPECT_FALSE(option.help.empty()) << name << ' ' << option.name;
    EXPECT_GE(OptionValues(method.options, {}).integer("rounds", 1), 1) << name;
  }
}

TEST_P(CgalMethod, KeepsAClosedManifoldOfTheSameTopologyOutside) {
  const TriangleMesh mesh = test_mesh();
  const TriangleMesh after = run(GetParam(), mesh).mesh;
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_EQ(euler_characteristic(after), euler_characteristic(mesh));
  EXPECT_NEAR(enclosed_volume(after), enclosed_volume(mesh), 0.1 * enclosed_volume(mesh));
}

TEST_P(CgalMethod, ChangesTheMesh) {
  EXPECT_NE(run(GetParam(), test_mesh(), {{"rounds", "1"}}).mesh.points, test_mesh().points);
}

TEST_P(CgalMethod, GivesTheSameBytesForAnyNumberOfThreads) {
  expect_same_for_any_threads([] { return format_off(run(GetParam(), test_mesh()).mesh, {}); });
}

TEST_P(CgalMethod, RefusesAnOpenMesh) {
  TriangleMesh mesh = test_mesh();
  mesh.triangles.pop_back();
  EXPECT_THROW(run(GetParam(), mesh), InvalidMesh);
}

TEST_P(CgalMethod, StopsWithCancelledWhenTheCallbackSaysSo) {
  const ProgressCallback refuse = [](std::string_view, double) { return false; };
  EXPECT_THROW(run(GetParam(), test_mesh(), {}, refuse), Cancelled);
}

TEST_P(CgalMethod, ReportsItsRoundsAndItsTimeAndThatMovesAreUnknown) {
  const MethodReport report = run(GetParam(), test_mesh(), {{"rounds", "2"}}).report;
  EXPECT_EQ(report.rounds_run, 2U);
  EXPECT_EQ(report.stopped_because, "rounds");
  EXPECT_EQ(report.moves.accepted, 0U);
  EXPECT_THAT(report.notes, ::testing::Contains(::testing::HasSubstr("moves are counted as none")));
  ASSERT_FALSE(report.seconds.empty());
  EXPECT_EQ(report.seconds.front().first, "smoothing");
}

TEST_P(CgalMethod, RejectsOptionsOutOfRange) {
  for (const Given& given : {Given{{"rounds", "-1"}}, Given{{"rounds", "1.5"}}, Given{{"beta", "1"}}})
    EXPECT_THROW(run(GetParam(), test_mesh(), given), InvalidOption) << given.begin()->first << ' ' << given.begin()->second;
}

TEST_P(CgalMethod, RefusesCoordinatesWhosePowersOverflow) {
  EXPECT_THROW(run(GetParam(), scaled(test_mesh(), 1e150), {{"rounds", "1"}}), InvalidMesh);
}

TEST_P(CgalSmoothing, MovesNothingInZeroRounds) {
  const TriangleMesh mesh = test_mesh();
  const MethodResult outcome = run(GetParam(), mesh, {{"rounds", "0"}});
  EXPECT_EQ(outcome.mesh.points, mesh.points);
  EXPECT_EQ(outcome.mesh.triangles, mesh.triangles);
}

/// Rounding, but for Ceres: it differentiates by differences and stops where the sum of squares changes by less than 1e-6 of itself, so that
/// a vertex may be off by about 1e-3 of the size of its star (0.3 here).
double tolerance(const std::string& method) {
  return method == "cgal_area" ? 1e-3 : 1e-9;
}

TEST_P(CgalSmoothing, GoesWithRigidMotions) {
  const auto moved = [](const TriangleMesh& mesh) { return translated(rotated(mesh, Vec3(1, 2, 3), 0.7), Vec3(4, -5, 6)); };
  const Given three = {{"rounds", "3"}};
  const TriangleMesh there = run(GetParam(), moved(test_mesh()), three).mesh, here = moved(run(GetParam(), test_mesh(), three).mesh);
  EXPECT_EQ(there.triangles.size(), here.triangles.size());
  EXPECT_LT(farthest(there.points, here.points), tolerance(GetParam()));
}

TEST_P(CgalSmoothing, GoesWithScaling) {
  constexpr double kFactor = 8;
  Given small = {{"rounds", "3"}}, large = small;
  if (GetParam() == "cgal_shape") {
    small["time"] = "0.001";
    large["time"] = "0.064";  // an area
  }
  const TriangleMesh there = run(GetParam(), scaled(test_mesh(), kFactor), large).mesh;
  const TriangleMesh here = scaled(run(GetParam(), test_mesh(), small).mesh, kFactor);
  EXPECT_LT(farthest(there.points, here.points), kFactor * tolerance(GetParam()));
}

TEST_P(CgalSmoothing, LeavesRegularSolidsAsTheyAre) {
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(0, 2.0)})
    EXPECT_LT(farthest(run(GetParam(), mesh).mesh.points, mesh.points), tolerance(GetParam()));
}

TEST_P(CgalSmoothing, RemovesVerticesWithoutTriangles) {
  TriangleMesh mesh = test_mesh();
  mesh.points.emplace_back(9, 9, 9);
  EXPECT_EQ(run(GetParam(), mesh).mesh.points, run(GetParam(), test_mesh()).mesh.points);
}

}  // namespace
}  // namespace smopt::baselines
