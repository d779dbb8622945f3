#include "smopt/surface/adaptive_surface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "smopt/surface/cell_surroundings.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/molecules.h"
#include "tests/support/threads.h"
#include "tests/surface/adaptive_interpolant.h"
#include "tests/surface/self_intersections.h"
#include "tests/surface/subdivided_field.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRadius = 1.7;
constexpr double kDecay = 0.6;

GaussianField field_of(const Molecule& molecule, double decay = kDecay) {
  return GaussianField(molecule, {decay, 1e-6});
}

TriangleMesh surface_of(const Molecule& molecule, double error) {
  return adaptive_surface(partition_space(field_of(molecule), 1, error));
}

double sphere_volume_error(double error) {
  const TriangleMesh mesh = surface_of(molecule_of({{0.1, 0.2, 0.3}}, {kRadius}), error);
  return std::abs(enclosed_volume(mesh) / (4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3)) - 1);
}

TEST(AdaptiveSurface, OfOneAtomIsItsSphereWithAVolumeErrorOfTheOrderOfTheError) {
  // The volume goes with the distance: relative error 3·distance/radius.
  for (const double error : {0.5, 0.1, 0.02}) EXPECT_LT(sphere_volume_error(error), 3 * error / kRadius) << error;
  EXPECT_LT(sphere_volume_error(0.005), 0.2 * sphere_volume_error(0.1));
}

TEST(AdaptiveSurface, OfTwoAtomsPartsWhereTheFieldBetweenThemFallsBelowTheIsovalue) {
  // Half-way the field is 2·exp(-d·(D²/4 - r²)), which is 1 at D = 2·sqrt(r² + ln 2 / d).
  const double distance = 2 * std::sqrt(kRadius * kRadius + std::log(2.0) / kDecay);
  const Vec3 direction = Vec3(1, 2, 3).normalized();
  for (const auto& [change, chi] : {std::pair{-0.01, 2}, std::pair{0.01, 4}}) {
    const TriangleMesh mesh = surface_of(molecule_of({{0, 0, 0}, (distance + change) * direction}, {kRadius, kRadius}), 0.05);
    EXPECT_EQ(euler_characteristic(mesh), chi) << change;
    EXPECT_THAT(mesh, IsClosedManifold());
    EXPECT_EQ(count_self_intersections(mesh), 0U);
  }
}

TEST(AdaptiveSurface, OfSymmetricMoleculesIsSound) {
  // Atoms at the corners of a cube: many equal values and exact ties.
  for (const double edge : {3.0, 3.5, 4.0, 4.5}) {
    std::vector<Vec3> centers;
    for (int i = 0; i < 8; ++i) centers.emplace_back(edge * (i & 1), edge * (i >> 1 & 1), edge * (i >> 2));
    for (const double error : {0.5, 0.1}) {
      const TriangleMesh mesh = surface_of(molecule_of(centers, std::vector<double>(8, 1.2)), error);
      EXPECT_THAT(mesh, IsClosedManifold()) << edge << " " << error;
      EXPECT_EQ(count_self_intersections(mesh), 0U) << edge << " " << error;
    }
  }
}

TEST(AdaptiveSurface, FarFromTheOriginIsTheSameShape) {
  const std::vector<Vec3> centers = {{0, 0, 0}, {2.5, 0.4, 0}, {1, 2.2, 1.4}};
  std::vector<Vec3> moved;
  for (const Vec3& c : centers) moved.push_back(c + Vec3(1e5, -1e5, 1e5));
  const TriangleMesh near = surface_of(molecule_of(centers, {1.7, 1.5, 1.2}), 0.1);
  const TriangleMesh far = surface_of(molecule_of(moved, {1.7, 1.5, 1.2}), 0.1);
  EXPECT_THAT(far, IsClosedManifold());
  EXPECT_EQ(count_self_intersections(far), 0U);
  EXPECT_NEAR(enclosed_volume(far), enclosed_volume(near), 1e-4 * enclosed_volume(near));
}

TEST(AdaptiveSurface, OfAtomsFarApartTakesNoMemoryForWhatIsBetween) {
  const TriangleMesh mesh = surface_of(molecule_of({{0, 0, 0}, {1e5, 1e5, -1e5}}, {kRadius, kRadius}), 0.3);
  EXPECT_EQ(euler_characteristic(mesh), 4);
  EXPECT_NEAR(enclosed_volume(mesh), 2 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3), 4);
}

TEST(AdaptiveSurface, IsTheSameForAnyNumberOfThreads) {
  const Molecule molecule = random_cluster(900, 1);
  expect_same_for_any_threads([&] {
    const TriangleMesh mesh = surface_of(molecule, 0.1);
    EXPECT_GT(mesh.vertex_count(), 10000U);
    return std::pair(mesh.points, mesh.triangles);
  });
}

TEST(AdaptivePartition, RefusesWhatItCannotDivide) {
  const GaussianField field = field_of(molecule_of({{0, 0, 0}, {1e5, 0, 0}}, {1, 1}));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) EXPECT_THROW(partition_space(field, 1, bad), InvalidOption);
  EXPECT_THAT([&] { partition_space(field, 1, 1e-7); }, ThrowsMessage<InvalidInput>(HasSubstr("an error of 1e-07")));
}

TEST(AdaptivePartition, HasNoTwoNeighboursThatDifferByMoreThanOneLevel) {
  const AdaptivePartition partition = partition_space(field_of(random_cluster(40, 2)), 1, 0.05);
  for_each_leaf(partition, [&](CellForest::Id leaf) {
    const CellPlace& place = partition.forest.cell(leaf).place;
    if (place.level < 2) return;
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          if (i * j * k != 0) continue;  // a corner may have any two levels
          const CellForest::Id other = partition.forest.find({{place.at[0] + i, place.at[1] + j, place.at[2] + k}, place.level});
          ASSERT_NE(other, CellForest::kNone);
          EXPECT_GE(partition.forest.cell(other).place.level, place.level - 1);
        }
      }
    }
  });
}

TEST(AdaptivePartition, HasAContinuousInterpolant) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> inside(0, 1);
  const AdaptivePartition partition = partition_space(field_of(random_cluster(40, 3)), 1, 0.05);
  std::size_t levels_compared = 0;
  for_each_leaf(partition, [&](CellForest::Id leaf) {
    const CellPlace& place = partition.forest.cell(leaf).place;
    if (place.level == 0) return;
    for (int face = 0; face < cube::kFaces; ++face) {
      Vec3 at(inside(random), inside(random), inside(random));
      at[face / 2] = face % 2;
      CellPlace beyond = place;
      beyond.at[static_cast<std::size_t>(face / 2)] += face % 2 == 1 ? 1 : -1;
      const CellForest::Id other = partition.forest.find(beyond);
      if (!partition.forest.is_leaf(other)) continue;
      const Vec3 in_other = (position_in_leaf(partition, leaf, at) - position_in_leaf(partition, other, Vec3::Zero())) /
                            partition.lattice.edge(partition.forest.cell(other).place.level);
      const double here = interpolant_in_leaf(partition, leaf, at);
      EXPECT_NEAR(interpolant_in_leaf(partition, other, in_other), here, 1e-9 * (1 + std::abs(here)));
      levels_compared += partition.forest.cell(other).place.level != place.level;
    }
  });
  EXPECT_GT(levels_compared, 100U);
}

TEST(AdaptivePartition, KeepsCellsOnlyWhereTheInterpolantIsMonotoneAlongAnAxisAlongWhichTheFieldIs) {
  std::size_t looked_at = 0;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const AdaptivePartition partition = partition_space(field_of(random_cluster(100, seed)), 1, 1);
    CellFinder finder(partition.forest);
    for_each_leaf(partition, [&](CellForest::Id leaf) {
      const CellForest::Cell& cell = partition.forest.cell(leaf);
      const cube::CornerValues values = continuous_values(finder, leaf, surroundings_of(finder, leaf));
      if (!cell.may_be_crossed || cell.place.level == partition.lattice.finest_level) return;
      EXPECT_NE(cube::monotone_axes(values) & cell.monotone_axes, 0U)
          << "seed " << seed << ", cell " << leaf << " of level " << cell.place.level;
      ++looked_at;
    });
  }
  EXPECT_GT(looked_at, 1000U);
}

/// Whether φ = c passes within a distance of a point, looked for along rays: φ − c has the other sign somewhere.
bool is_near_level_set(const GaussianField& field, const Vec3& x, double distance) {
  const FieldJet jet = field.jet(x);
  const bool inside = jet.value >= 1;
  const auto is_other_side = [&](const Vec3& y) { return (field.value(y) >= 1) != inside; };
  const Vec3 uphill = jet.gradient.normalized() * (inside ? -1 : 1);
  if (jet.gradient.norm() > 0 && is_other_side(x + distance * uphill)) return true;
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        for (int k = -2; k <= 2; ++k) {
          const Vec3 direction(i, j, k);
          if (i != 0 || j != 0 || k != 0) {
            if (is_other_side(x + part * distance * direction.normalized())) return true;
          }
        }
      }
    }
  }
  return false;
}

/// Points of the interpolant's surface inside a cell: on lines along an axis, on which the interpolant is linear.
std::optional<Vec3> random_surface_point(const AdaptivePartition& partition, CellForest::Id leaf, std::mt19937& random) {
  std::uniform_real_distribution<double> inside(0, 1);
  Vec3 low(inside(random), inside(random), inside(random));
  Vec3 high = low;
  const auto axis = static_cast<int>(random() % 3);
  low[axis] = 0;
  high[axis] = 1;
  const double a = interpolant_in_leaf(partition, leaf, low);
  const double b = interpolant_in_leaf(partition, leaf, high);
  if ((a >= 0) == (b >= 0)) return std::nullopt;
  return position_in_leaf(partition, leaf, low + a / (a - b) * (high - low));
}

/// Counts points of the interpolant's surface, and those that are farther than the error from the level set.
void expect_surface_within_error(const Molecule& molecule, double decay, double error, std::uint32_t seed) {
  const GaussianField field = field_of(molecule, decay);
  const AdaptivePartition partition = partition_space(field, 1, error);
  std::mt19937 random(seed);
  std::size_t tried = 0;
  std::size_t off = 0;
  for_each_leaf(partition, [&](CellForest::Id leaf) {
    for (int i = 0; i < 4; ++i) {
      const std::optional<Vec3> x = random_surface_point(partition, leaf, random);
      if (!x) continue;
      ++tried;
      off += !is_near_level_set(field, *x, error);
    }
  });
  EXPECT_GT(tried, 100U);
  EXPECT_EQ(off, 0U) << "of " << tried << " points; error " << error << ", decay " << decay << ", seed " << seed;
}

TEST(AdaptivePartition, KeepsTheInterpolantsSurfaceWithinTheErrorOfTheLevelSet) {
  std::uint32_t seed = 100;
  for (const double decay : {0.3, 0.6, 1.2}) {
    for (const double error : {1.0, 0.4, 0.1, 0.03}) {
      expect_surface_within_error(random_cluster(20, seed), decay, error, seed);
      ++seed;
    }
  }
}

TEST(AdaptiveSurface, HasTheTopologyOfTheInterpolant) {
  int compared = 0;
  for (std::uint32_t seed = 200; seed < 214; ++seed) {
    const AdaptivePartition partition = partition_space(field_of(random_cluster(2 + seed % 5, seed)), 1, 0.5);
    const TriangleMesh mesh = adaptive_surface(partition);
    const int coarse = SubdividedField(sampled_interpolant(partition, 2), 1).euler_characteristic_of_level_set();
    const int fine = SubdividedField(sampled_interpolant(partition, 3), 1).euler_characteristic_of_level_set();
    if (coarse != fine) continue;  // the oracle cannot tell
    ++compared;
    EXPECT_EQ(euler_characteristic(mesh), fine) << "seed " << seed;
  }
  EXPECT_GT(compared, 10);
}

TEST(AdaptiveSurface, OfTheAcheMonomerIsSound) {
  const std::filesystem::path file = apbs_molecule("misc/mache.pqr");
  if (file.empty()) GTEST_SKIP() << "apbs-data is not installed";
  AdaptiveSurfaceReport report;
  const TriangleMesh mesh = adaptive_surface(partition_space(field_of(read_molecule(file)), 1, 1), &report);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(count_self_intersections(mesh), 0U);
  EXPECT_GT(enclosed_volume(mesh), 0);
  EXPECT_GT(report.hanging_cells, 1000U);
}

}  // namespace
}  // namespace smopt
