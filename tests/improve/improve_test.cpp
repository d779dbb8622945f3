#include "smopt/improve/improve.h"

#include <algorithm>

#include "metrics/measure.h"
#include "metrics/shape.h"
#include "smopt/error.h"
#include "smopt/surface/gaussian_surface.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Inwards as a whole, some triangles turned, isolated vertices, redundant points of both kinds, a cavity with an island, and a second
/// outer component. The outer ones have 162 and 42 vertices that are not redundant.
TriangleMesh with_everything() {
  const TriangleMesh outer = noisy(icosphere(2, 10), 0.4, 3), second = icosphere(1, 3, {30, 0, 0});
  TriangleMesh mesh = joined(with_points_in_faces(outer, 1), with_points_on_edges(second, 1));
  mesh = joined(mesh, joined(reversed(icosphere(1, 4)), icosphere(0, 1)));
  mesh = reversed(mesh);
  for (const FaceId f : {10U, 100U, 600U}) std::swap(mesh.triangles[f][0], mesh.triangles[f][2]);
  mesh.points.emplace_back(1, 2, 3);
  return mesh;
}

std::vector<std::string> names_of(const StageTimes& seconds) {
  std::vector<std::string> names;
  for (const auto& [name, time] : seconds) names.push_back(name);
  return names;
}

TEST(Improve, DoesItAllToAMeshWithEverything) {
  TriangleMesh mesh = with_everything();
  const ImproveReport report = improve(mesh, {});
  EXPECT_TRUE(report.preparation.was_inward);
  EXPECT_EQ(report.preparation.isolated_vertices, 1U);
  EXPECT_GT(report.preparation.turned_triangles, 0U);
  EXPECT_EQ(report.preparation.cavities.components, 4U);
  EXPECT_EQ(report.preparation.cavities.cavities, 1U);
  EXPECT_EQ(report.preparation.cavities.islands, 1U);
  EXPECT_EQ(report.preparation.cavities.cavity_vertices, 42U + 12U);
  EXPECT_EQ(report.redundant.valence3, 320U);
  EXPECT_EQ(report.redundant.valence4, 120U);
  EXPECT_FALSE(report.smoothing.rounds.empty());
  EXPECT_EQ(mesh.vertex_count(), 162U + 42U);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_THAT(mesh, HasNoIntersections());
  EXPECT_EQ(euler_characteristic(mesh), 4);
  EXPECT_GT(enclosed_volume(mesh), 0);
  EXPECT_GE(smallest_angle_deg(mesh), 10);
}

TEST(Improve, ReportsTheTimeOfEachStage) {
  TriangleMesh mesh = with_everything();
  const ImproveReport report = improve(mesh, {});
  EXPECT_THAT(names_of(report.seconds), ElementsAre("validity", "cavities", "redundant", "smoothing"));
  for (const auto& [name, time] : report.seconds) EXPECT_GE(time.wall, 0) << name;
}

TEST(Improve, OnlyPreparesWithZeroRoundsAndRedundantPointsKept) {
  TriangleMesh mesh = with_everything(), expected = with_everything();
  ImproveOptions options;
  options.deletes_redundant_points = false;
  options.smoothing.rounds = 0;
  const ImproveReport report = improve(mesh, options);
  prepare(expected, CavityPolicy::delete_cavities);
  EXPECT_TRUE(is_same(mesh, expected));
  EXPECT_EQ(report.redundant.valence3 + report.redundant.valence4, 0U);
  EXPECT_THAT(report.smoothing.rounds, IsEmpty());
}

TEST(Improve, IsTheSameSurfaceForInwardAndOutwardInput) {
  const TriangleMesh outward = noisy(torus(2, 0.7, 30, 14), 0.08, 2);
  TriangleMesh a = outward, b = reversed(outward);
  improve(a, {});
  improve(b, {});
  EXPECT_TRUE(is_same(a, b));
}

TEST(Improve, RejectsAnOpenMeshAndLeavesItAlone) {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.pop_back();
  const TriangleMesh before = mesh;
  EXPECT_THROW(improve(mesh, {}), InvalidMesh);
  EXPECT_TRUE(is_same(mesh, before));
}

TEST(Improve, StopsWithCancelledInEachStage) {
  for (const std::string_view stop_in : {"redundant points", "smoothing"}) {
    TriangleMesh mesh = with_everything();
    EXPECT_THROW(improve(mesh, {}, [&](std::string_view stage, double) { return stage != stop_in; }), Cancelled) << stop_in;
  }
}

TEST(Improve, MakesTheSurfacesOfRandomMoleculesFitForUse) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    TriangleMesh mesh = random_molecule_surface(80, seed), reference = mesh;
    prepare(reference, CavityPolicy::delete_cavities);
    improve(mesh, {});
    EXPECT_THAT(mesh, HasNoIntersections());
    EXPECT_THAT(mesh, IsClosedManifold());
    EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(reference));
    std::vector<std::string> notes;
    EXPECT_LE(metrics::measure_shape(mesh, notes).angle.smallest_below_20.value(), 0.05);
    EXPECT_GT(metrics::measure_shape(reference, notes).angle.smallest_below_20.value(), 0.1);
  }
}

TEST(Improve, MeetsTheRequirementsOnAcetylcholinesterase) {
  const std::filesystem::path file = apbs_molecule("misc/mache.pqr");
  if (file.empty()) GTEST_SKIP() << "Debian's apbs-data is not installed: no misc/mache.pqr";
  TriangleMesh mesh = gaussian_surface(read_molecule(file), {});
  TriangleMesh reference = mesh;
  prepare(reference, CavityPolicy::delete_cavities);
  improve(mesh, {});
  const metrics::Measurement after = metrics::measure(mesh);
  EXPECT_EQ(after.intersecting_pairs, std::size_t{0});
  EXPECT_EQ(after.topology.components, 1U);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(reference));
  EXPECT_NEAR(enclosed_volume(mesh) / enclosed_volume(reference), 1, 0.03);
  EXPECT_LE(after.shape.edge_ratio.share_below_01.value(), 0.001);
  EXPECT_LE(after.shape.angle.smallest_below_20.value(), 0.05);
}

}  // namespace
}  // namespace smopt
