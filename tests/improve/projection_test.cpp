#include "smopt/improve/projection.h"

#include <gmock/gmock.h>

#include <cmath>

#include "smopt/surface/gaussian_surface.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/molecules.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt {
namespace {

using namespace testing;

constexpr double kRadius = 1.7;
const GaussianFieldOptions kField{0.6, 1e-9};

Molecule one_atom() {
  return molecule_of({{0, 0, 0}}, {kRadius});
}

/// Whatever the molecule: closed, without intersections, of the same connectivity.
void expect_sound_projection(const Molecule& molecule, const ProjectionOptions& options, const std::string& what) {
  const GaussianField field(molecule, kField);
  const TriangleMesh before = gaussian_surface(molecule, {});
  TriangleMesh mesh = before;
  const ProjectionReport report = project_onto_level_set(mesh, field, 1, options);
  EXPECT_EQ(mesh.triangles, before.triangles) << what;
  EXPECT_THAT(mesh, HasNoIntersections()) << what;
  EXPECT_LE(report.after.mean, report.before.mean) << what;
  EXPECT_GT(report.arrived, mesh.vertex_count() / 2) << what;
}

TEST(LevelSetDistance, OfAPointToTheSphereOfOneAtomIsItsDistanceToTheSphere) {
  const GaussianField field(one_atom(), kField);
  for (const double radius : {0.8, 1.5, 1.7, 2.3}) {
    const Vec3 x = radius * Vec3(1, -2, 2).normalized();
    EXPECT_NEAR(distance_to_level_set(field, 1, {x}).largest, std::abs(radius - kRadius), 1e-9);
    EXPECT_NEAR((*foot_on_level_set(field, 1, x) - kRadius * x.normalized()).norm(), 0, 1e-9);
  }
}

TEST(LevelSetDistance, CountsPointsFromWhichTheGradientDoesNotLeadThere) {
  const GaussianField field(one_atom(), kField);
  const LevelSetDistance distance = distance_to_level_set(field, 1, {{0, 0, 0}, {100, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(distance.unresolved, 2U);
  EXPECT_NEAR(distance.mean, 2 - kRadius, 1e-9);
}

TEST(Projection, BringsEveryVertexOntoASphere) {
  const GaussianField field(one_atom(), kField);
  TriangleMesh mesh = noisy(icosphere(3, kRadius), 0.05, 1);
  const ProjectionReport report = project_onto_level_set(mesh, field, 1);
  EXPECT_EQ(report.stopped_because, "all arrived");
  EXPECT_EQ(report.arrived, mesh.vertex_count());
  EXPECT_GT(report.before.largest, 0.01);
  for (const Vec3& p : mesh.points) EXPECT_NEAR(p.norm(), kRadius, 1e-6);
}

TEST(Projection, LeavesVerticesOnTheLevelSetWhereTheyAre) {
  const GaussianField field(one_atom(), kField);
  const TriangleMesh before = icosphere(2, kRadius);
  TriangleMesh mesh = before;
  const ProjectionReport report = project_onto_level_set(mesh, field, 1);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(report.rounds, 0);
}

TEST(Projection, NeverCreatesAnIntersectingPair) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    ProjectionOptions options;
    options.keeps_angles = seed % 2 == 0;
    Molecule molecule = random_cluster(40 * seed, seed);
    molecule.radii.front() = 2;
    expect_sound_projection(molecule, options, "seed " + std::to_string(seed));
  }
}

TEST(Projection, IsTheSameForAnyNumberOfThreads) {
  const Molecule molecule = random_cluster(900, 3);
  const GaussianField field(molecule, kField);
  const TriangleMesh before = gaussian_surface(molecule, {});
  expect_same_for_any_threads([&] {
    TriangleMesh mesh = before;
    project_onto_level_set(mesh, field, 1);
    return mesh.points;
  });
}

TEST(Projection, RefusesBadOptionsAndOpenMeshes) {
  const GaussianField field(one_atom(), kField);
  TriangleMesh mesh = icosphere(1, kRadius);
  EXPECT_THROW(project_onto_level_set(mesh, field, 1, {.rounds = -1}), InvalidOption);
  EXPECT_THROW(project_onto_level_set(mesh, field, 1, {.tolerance = 0}), InvalidOption);
  mesh.triangles.pop_back();
  EXPECT_THROW(project_onto_level_set(mesh, field, 1), InvalidMesh);
}

}  // namespace
}  // namespace smopt
