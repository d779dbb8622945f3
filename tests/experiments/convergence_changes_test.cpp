#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/convergence/change_explanation.h"
#include "experiments/convergence/interpolant.h"
#include "metrics/topology.h"
#include "smopt/surface/adaptive_surface.h"
#include "tests/experiments/convergence_molecules.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::SizeIs;

std::int64_t sum_of(const std::vector<EulerPart>& parts) {
  std::int64_t sum = 0;
  for (const EulerPart& part : parts) sum += part.euler;
  return sum;
}

std::int64_t sum_of(const std::vector<TopologyChange>& changes) {
  std::int64_t sum = 0;
  for (const TopologyChange& change : changes) sum += change.change;
  return sum;
}

std::int64_t euler_by_metrics(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  return metrics::measure_topology(mesh, notes).euler_characteristic;
}

AdaptiveMesh mesh_for(const GaussianField& field, double error) {
  AdaptiveMesh mesh;
  mesh.error = error;
  mesh.partition = partition_space(field, 1, error);
  mesh.mesh = adaptive_surface(mesh.partition);
  return mesh;
}

TEST(EulerByParts, OfACubeOnTheLatticeAreItsCornersEdgesAndFaces) {
  CellLattice lattice;  // origin 0, edge 1: all of the cube lies in planes
  std::map<int, int> count_of;
  for (const EulerPart& part : euler_by_parts(testing::cube(), lattice)) ++count_of[static_cast<int>(part.euler)];
  EXPECT_THAT(count_of, ElementsAre(std::pair(-1, 12), std::pair(1, 14)));
}

TEST(EulerByParts, OfACubeInsideOneCellAreOnePart) {
  CellLattice lattice;
  lattice.origin = Vec3::Constant(-0.5);
  lattice.root_edge = 2;
  EXPECT_THAT(euler_by_parts(testing::cube(), lattice), ElementsAre(EulerPart{{1, 1, 1}, 2}));
}

TEST(EulerByParts, SumUpToTheSurfacesOwn) {
  CellLattice lattice;
  lattice.origin = Vec3(-0.1, 0.2, 0.3);
  lattice.root_edge = 0.37;
  EXPECT_EQ(sum_of(euler_by_parts(icosphere(4, 1.5), lattice)), 2);
  EXPECT_EQ(sum_of(euler_by_parts(torus(2, 0.7, 40, 20), lattice)), 0);
  EXPECT_EQ(sum_of(euler_by_parts(joined(icosphere(3), reversed(icosphere(2, 0.5))), lattice)), 4);
}

TEST(TopologyChanges, AreFoundWhereTwoAtomsPartAndNowhereElse) {
  const double distance = merging_distance();
  const AdaptiveMesh together = mesh_for(field_of(two_atoms(distance - 0.02)), 0.05);
  const AdaptiveMesh apart = mesh_for(field_of(two_atoms(distance + 0.02)), 0.05);
  ASSERT_EQ(euler_by_metrics(together.mesh), 2);
  ASSERT_EQ(euler_by_metrics(apart.mesh), 4);

  const CellLattice& lattice = together.partition.lattice;
  const std::vector<TopologyChange> changes = topology_changes(euler_by_parts(together.mesh, lattice), euler_by_parts(apart.mesh, lattice));
  ASSERT_THAT(changes, SizeIs(1));
  EXPECT_EQ(changes.front().change, 2);
  EXPECT_THAT(widened(changes.front().cells), Contains(cell_at(lattice, distance / 2 * Vec3(1, 2, 3).normalized())));
  EXPECT_LT(changes.front().cells.size(), 10U);
}

TEST(TopologyChanges, InAPlaneAreInTheCellsOnBothSides) {
  const std::vector<TopologyChange> changes = topology_changes({}, std::vector<EulerPart>{{{2, 1, 1}, 2}});
  ASSERT_THAT(changes, SizeIs(1));
  EXPECT_THAT(changes.front().cells, ElementsAre(LatticeCell{0, 0, 0}, LatticeCell{1, 0, 0}));
}

TEST(TopologyChanges, FarApartAreTwoAndSideBySideCancel) {
  const auto after = [](std::int32_t x) { return std::vector<EulerPart>{{{1, 1, 1}, 2}, {{x, 1, 1}, -2}}; };
  EXPECT_THAT(topology_changes({}, after(41)), SizeIs(2));
  EXPECT_THAT(topology_changes({}, after(3)), SizeIs(0));
}

TEST(TopologyChanges, OfASurfaceThatMovesAreNone) {
  CellLattice lattice;
  lattice.origin = Vec3::Constant(-10.03);
  const TriangleMesh sphere = icosphere(5, 2.2);
  for (const double by : {0.05, 0.3, 0.9}) {
    const TriangleMesh moved = translated(sphere, by * Vec3(0.3, 0.5, 0.8));
    EXPECT_EQ(sum_of(topology_changes(euler_by_parts(sphere, lattice), euler_by_parts(moved, lattice))), 0) << by;
  }
  EXPECT_THAT(topology_changes(euler_by_parts(sphere, lattice), euler_by_parts(sphere, lattice)), SizeIs(0));
}

TEST(TopologyChanges, SumUpToTheChangeOfTheWhole) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const GaussianField field = field_of(random_cluster(150, seed));
    const AdaptiveMesh coarser = mesh_for(field, 1.5);
    const AdaptiveMesh finer = mesh_for(field, 0.1);
    const CellLattice& lattice = coarser.partition.lattice;
    const auto changes = topology_changes(euler_by_parts(coarser.mesh, lattice), euler_by_parts(finer.mesh, lattice));
    EXPECT_EQ(sum_of(changes), euler_by_metrics(finer.mesh) - euler_by_metrics(coarser.mesh)) << "seed " << seed;
  }
}

TEST(Interpolant, IsZeroAtTheVerticesOnEdgesAndHasTheSignsOfTheInside) {
  const GaussianField field = field_of(two_atoms(merging_distance() - 0.5));
  const AdaptivePartition partition = partition_space(field, 1, 0.2);
  AdaptiveSurfaceReport report;
  const TriangleMesh mesh = adaptive_surface(partition, &report);
  const auto elsewhere = static_cast<std::size_t>(std::count_if(mesh.points.begin(), mesh.points.end(), [&](const Vec3& point) {
    return std::abs(interpolant_at(partition, point).value()) > 1e-6;
  }));
  EXPECT_LE(elsewhere, report.interior_vertices);
  EXPECT_LT(elsewhere, mesh.vertex_count() / 4);

  const Vec3 outwards = Vec3(3, 0, -1).normalized();
  EXPECT_GT(interpolant_at(partition, (kRadius - 0.4) * outwards).value(), 0);
  EXPECT_LT(interpolant_at(partition, (kRadius + 0.4) * outwards).value(), 0);
  EXPECT_FALSE(interpolant_at(partition, Vec3::Constant(100)));
}

/// The first two errors in a row between which the topology of two atoms slightly apart changes.
std::vector<ExplainedChange> first_changes(const GaussianField& field, double& coarser_error) {
  AdaptiveMesh coarser = mesh_for(field, 2);
  for (double error = 1; error > 0.01; error /= 2) {
    AdaptiveMesh finer = mesh_for(field, error);
    if (euler_by_metrics(coarser.mesh) != euler_by_metrics(finer.mesh)) {
      coarser_error = coarser.error;
      return explained_changes(field, 1, coarser, finer);
    }
    coarser = std::move(finer);
  }
  return {};
}

TEST(ExplainedChanges, OfTwoAtomsSlightlyApartAreTheNeckThatACoarseSurfaceDrawsBetweenThem) {
  const double distance = merging_distance() + 0.05;
  const GaussianField field = field_of(two_atoms(distance));
  double error = 0;
  const std::vector<ExplainedChange> changes = first_changes(field, error);
  ASSERT_THAT(changes, SizeIs(1));
  const ExplainedChange& change = changes.front();
  EXPECT_EQ(change.place.change, 2);
  EXPECT_EQ(change.explanation, Explanation::passed);
  ASSERT_THAT(change.points, SizeIs(1));

  const ExplainingPoint& point = change.points.front();
  const double value = 2 * std::exp(-kDecay * (distance * distance / 4 - kRadius * kRadius));
  const double largest_curvature = (kDecay * kDecay * distance * distance - 2 * kDecay) * value;
  EXPECT_LT((point.point.position - distance / 2 * Vec3(1, 2, 3).normalized()).norm(), 1e-4);
  EXPECT_NEAR(point.point.value, value, 1e-5);
  EXPECT_EQ(point.point.index(), 2);
  EXPECT_NEAR(point.ratio, (1 - value) / (0.5 * largest_curvature * error * error), 1e-3);
  EXPECT_LT(point.ratio, 1);
  EXPECT_GE(point.coarser.value(), 0);
  EXPECT_LT(point.finer.value(), 0);
  EXPECT_LE(change.largest_distance, error);
}

TEST(ExplainedChanges, SumUpToTheChangeOfTheWholeAndNameOnlyPointsThatAreCritical) {
  for (const std::uint32_t seed : {4U, 5U}) {
    const GaussianField field = field_of(random_cluster(200, seed));
    const AdaptiveMesh coarser = mesh_for(field, 1);
    const AdaptiveMesh finer = mesh_for(field, 0.25);
    std::int64_t sum = 0;
    for (const ExplainedChange& change : explained_changes(field, 1, coarser, finer)) {
      sum += change.place.change;
      for (const ExplainingPoint& point : change.points)
        EXPECT_LT(field.jet(point.point.position).gradient.norm(), 1e-3) << "seed " << seed;
    }
    EXPECT_EQ(sum, euler_by_metrics(finer.mesh) - euler_by_metrics(coarser.mesh)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace smopt::experiments
