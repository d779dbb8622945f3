#include <gmock/gmock.h>

#include "baselines/cgal/isotropic_remeshing.h"
#include "baselines/cgal/remesh_method.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/baselines/method_run.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::Contains;
using ::testing::HasSubstr;

MethodResult run(TriangleMesh mesh, const std::map<std::string, std::string>& given) {
  return run_method(remesh_method(), std::move(mesh), given);
}

TriangleMesh remeshed(TriangleMesh mesh, const RemeshingOptions& options) {
  remesh_isotropically(mesh, options);
  return mesh;
}

/// About a sphere of radius 10, with edges of 0.2 to 1.8: no edge length stands out by symmetry.
TriangleMesh uneven_sphere() {
  TriangleMesh mesh = icosphere(4, 10.0);
  for (Vec3& p : mesh.points) p = 10 * (p + 4 * Vec3::UnitX()).normalized();
  return noisy(mesh, 0.05, 3);
}

TEST(MeanEdgeLength, OfACubeByHand) {
  // Twelve edges of length 1 and six diagonals of √2.
  EXPECT_NEAR(mean_edge_length(cube()), (12 + 6 * std::sqrt(2.0)) / 18, 1e-15);
}

TEST(Remeshing, ReachesTheEdgeLengthOnTheMean) {
  for (const double length : {0.5, 1.0, 1.7}) {
    const TriangleMesh after = run(uneven_sphere(), {{"edge-length", std::to_string(length)}}).mesh;
    EXPECT_NEAR(mean_edge_length(after), length, 0.1 * length);
  }
}

TEST(Remeshing, StaysOnTheInitialSurface) {
  // The polyhedron is between the spheres around its corners and within its faces.
  const TriangleMesh mesh = icosphere(3, 10.0);
  double inner = 10;
  for (const auto& [a, b, c] : mesh.triangles) inner = std::min(inner, (mesh.points[a] + mesh.points[b] + mesh.points[c]).norm() / 3);
  for (const Vec3& p : remeshed(mesh, {.edge_length = 0.6}).points) {
    EXPECT_LE(p.norm(), 10 + 1e-9);
    EXPECT_GE(p.norm(), inner - 1e-3);
  }
}

TEST(Remeshing, MakesLongTrianglesIntoGoodOnes) {
  TriangleMesh mesh = icosphere(3);
  for (Vec3& p : mesh.points) p.x() *= 8;
  const TriangleMesh after = run(mesh, {{"rounds", "5"}}).mesh;
  const auto shortest_by_longest = [](const TriangleMesh& m) {
    double sum = 0;
    for (const auto& [a, b, c] : m.triangles) {
      const auto [low, high] =
          std::minmax({(m.points[b] - m.points[a]).norm(), (m.points[c] - m.points[b]).norm(), (m.points[a] - m.points[c]).norm()});
      sum += low / high;
    }
    return sum / static_cast<double>(m.triangles.size());
  };
  EXPECT_LT(shortest_by_longest(mesh), 0.5);
  EXPECT_GT(shortest_by_longest(after), 0.7);
}

TEST(Remeshing, SwitchesAreCgals) {
  const TriangleMesh mesh = noisy(icosphere(2, 2.0), 0.1, 4);
  const RemeshingOptions still{
      .edge_length = mean_edge_length(mesh), .rounds = 2, .relax_rounds = 0, .splits = false, .collapses = false, .flips = false};
  const TriangleMesh same = remeshed(mesh, still);
  EXPECT_EQ(same.triangles, mesh.triangles);

  RemeshingOptions splitting = still;
  splitting.splits = true;
  splitting.edge_length = 0.7 * still.edge_length;
  EXPECT_GT(remeshed(mesh, splitting).vertex_count(), mesh.vertex_count());
  RemeshingOptions collapsing = still;
  collapsing.collapses = true;
  collapsing.edge_length = 1.4 * still.edge_length;
  EXPECT_LT(remeshed(mesh, collapsing).vertex_count(), mesh.vertex_count());
  RemeshingOptions flipping = still;
  flipping.flips = true;
  EXPECT_EQ(remeshed(mesh, flipping).vertex_count(), mesh.vertex_count());
  EXPECT_NE(remeshed(mesh, flipping).triangles, mesh.triangles);
  RemeshingOptions relaxing = still;
  relaxing.relax_rounds = 1;
  EXPECT_NE(remeshed(mesh, relaxing).points, same.points);
  RemeshingOptions drifting = relaxing;
  drifting.projects = false;
  EXPECT_NE(remeshed(mesh, drifting).points, remeshed(mesh, relaxing).points);
}

TEST(Remeshing, GoesWithRigidMotionsOnTheWhole) {
  const TriangleMesh mesh = noisy(torus(3, 1, 40, 20), 0.03, 5);
  const TriangleMesh here = run(mesh, {}).mesh, there = run(translated(rotated(mesh, Vec3(1, 2, 3), 0.7), Vec3(4, 5, 6)), {}).mesh;
  EXPECT_NEAR(static_cast<double>(there.vertex_count()), static_cast<double>(here.vertex_count()),
              0.01 * static_cast<double>(here.vertex_count()));
  EXPECT_NEAR(surface_area(there), surface_area(here), 1e-3 * surface_area(here));
}

TEST(RemeshMethod, TakesTheMeansLengthByDefaultAndSaysSo) {
  const TriangleMesh mesh = icosphere(3, 5.0);
  const RemeshingOptions options{.edge_length = mean_edge_length(mesh)};
  const MethodResult outcome = run(mesh, {});
  EXPECT_EQ(outcome.mesh.points, remeshed(mesh, options).points);
  EXPECT_THAT(outcome.report.notes, Contains(HasSubstr("edge length 0.")));
}

TEST(RemeshMethod, MeetsANumberOfVertices) {
  const TriangleMesh mesh = noisy(torus(3, 1, 60, 30), 0.01, 6);
  for (const std::size_t target : {700U, 1800U, 5000U}) {
    const MethodResult outcome = run(mesh, {{"vertices", std::to_string(target)}});
    EXPECT_NEAR(static_cast<double>(outcome.mesh.vertex_count()), static_cast<double>(target), 0.01 * static_cast<double>(target));
    EXPECT_THAT(outcome.report.notes, Contains(HasSubstr(std::to_string(target) + " asked for")));
    EXPECT_EQ(outcome.report.seconds.front().first, "smoothing");
  }
}

TEST(RemeshMethod, MeetsTheNumberOfVerticesOfAMesh) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "match.off").string();
  write_mesh(file, icosphere(3));  // 642
  EXPECT_NEAR(static_cast<double>(run(torus(3, 1, 60, 30), {{"match", file}}).mesh.vertex_count()), 642, 6.42);
}

TEST(RemeshMethod, SaysWhenTheNumberIsMissed) {
  const MethodResult outcome = run(torus(3, 1, 60, 30), {{"vertices", "4"}});  // no torus has so few
  EXPECT_THAT(outcome.report.notes, Contains(HasSubstr("missed by more than 1 %")));
}

TEST(RemeshMethod, RefusesMoreVerticesThanMemoryHolds) {
  TriangleMesh mesh = icosphere(1);
  const Method method = remesh_method();
  EXPECT_THROW(method.run(mesh, OptionValues(method.options, {{"vertices", "2000000000"}}), {}), InvalidOption);
}

TEST(RemeshMethod, RejectsContradictions) {
  EXPECT_THROW(run(icosphere(1), {{"edge-length", "-1"}}), InvalidOption);
  EXPECT_THROW(run(icosphere(1), {{"vertices", "100"}, {"match", "x.off"}}), InvalidOption);
  EXPECT_THROW(run(icosphere(1), {{"vertices", "100"}, {"edge-length", "1"}}), InvalidOption);
  EXPECT_THROW(run(icosphere(1), {{"split", "maybe"}}), InvalidOption);
  EXPECT_THROW(run(icosphere(1), {{"edge-length", "1e-5"}}), InvalidOption);  // 10¹¹ vertices
}

}  // namespace
}  // namespace smopt::baselines
