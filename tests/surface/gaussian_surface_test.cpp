#include "smopt/surface/gaussian_surface.h"

#include <gmock/gmock.h>
#include <malloc.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <thread>

#include "smopt/peak_memory.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/surface_estimate.h"
#include "smopt/surface/trilinear_surface.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/molecules.h"
#include "tests/surface/mesh_shape.h"
#include "tests/surface/self_intersections.h"

namespace smopt {
namespace {

using testing::count_self_intersections;
using testing::enclosed_volume;
using testing::euler_characteristic;
using ::testing::HasSubstr;
using testing::IsClosedManifold;
using testing::molecule_of;
using testing::shape_of;
using testing::surface_area;
using ::testing::ThrowsMessage;

GaussianSurfaceOptions with_spacing(double spacing) {
  GaussianSurfaceOptions options;
  options.spacing = spacing;
  return options;
}

constexpr double kRadius = 1.7;

/// At isovalue 1 the surface of one atom is its sphere.
double sphere_area_error(double spacing) {
  const TriangleMesh mesh = gaussian_surface(molecule_of({{0.1, 0.2, 0.3}}, {kRadius}), with_spacing(spacing));
  return std::abs(surface_area(mesh) / (4 * std::numbers::pi * kRadius * kRadius) - 1);
}

double sphere_volume_error(double spacing) {
  const TriangleMesh mesh = gaussian_surface(molecule_of({{0.1, 0.2, 0.3}}, {kRadius}), with_spacing(spacing));
  return std::abs(enclosed_volume(mesh) / (4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3)) - 1);
}

TEST(GaussianSurface, OfOneAtomIsItsSphereWithErrorsOfSecondOrder) {
  for (const double spacing : {0.2, 0.1}) {
    EXPECT_LT(sphere_volume_error(spacing), spacing * spacing);
    EXPECT_NEAR(std::log2(sphere_volume_error(spacing) / sphere_volume_error(spacing / 2)), 2, 0.2) << spacing;
    EXPECT_NEAR(std::log2(sphere_area_error(spacing) / sphere_area_error(spacing / 2)), 2, 0.3) << spacing;
  }
}

TEST(GaussianSurface, OfOneAtomWithAnotherIsovalueIsAnotherSphere) {
  GaussianSurfaceOptions options = with_spacing(0.05);
  options.isovalue = 0.4;
  const TriangleMesh mesh = gaussian_surface(molecule_of({{0, 0, 0}}, {kRadius}), options);
  const double radius = std::sqrt(kRadius * kRadius - std::log(options.isovalue) / options.decay);
  EXPECT_NEAR(enclosed_volume(mesh), 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0.02);
}

TEST(GaussianSurface, OfTwoAtomsPartsWhereTheFieldBetweenThemFallsBelowTheIsovalue) {
  // Half-way the field is 2·exp(-d·(D²/4 - r²)), which is 1 at D = 2·sqrt(r² + ln 2 / d).
  const double distance = 2 * std::sqrt(kRadius * kRadius + std::log(2.0) / 0.6);
  const Vec3 direction = Vec3(1, 2, 3).normalized();
  for (const auto& [change, chi] : {std::pair{-0.03, 2}, std::pair{0.03, 4}}) {
    const TriangleMesh mesh =
        gaussian_surface(molecule_of({{0, 0, 0}, (distance + change) * direction}, {kRadius, kRadius}), with_spacing(0.1));
    EXPECT_EQ(euler_characteristic(mesh), chi) << change;
    EXPECT_THAT(mesh, IsClosedManifold());
    EXPECT_EQ(count_self_intersections(mesh), 0U);
  }
}

TEST(GaussianSurface, OfAtomsAtTheSamePlaceIsALargerSphere) {
  const Molecule molecule = molecule_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {kRadius, kRadius, kRadius});
  const TriangleMesh mesh = gaussian_surface(molecule, with_spacing(0.1));
  const double radius = std::sqrt(kRadius * kRadius + std::log(3.0) / 0.6);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_NEAR(enclosed_volume(mesh), 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0.1);
}

TEST(GaussianSurface, AtomsOfRadiusZeroCount) {
  const Molecule molecule = molecule_of({{0, 0, 0}, {0.3, 0, 0}}, {0, 0});
  const TriangleMesh mesh = gaussian_surface(molecule, with_spacing(0.1));
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_GT(enclosed_volume(mesh), 0);
}

TEST(GaussianSurface, OfSymmetricMoleculesIsSound) {
  // Atoms at the corners of a cube, on a grid with the same symmetry: many equal values and exact ties.
  for (const double edge : {3.0, 3.5, 4.0, 4.5}) {
    std::vector<Vec3> centers;
    for (int i = 0; i < 8; ++i) centers.emplace_back(edge * (i & 1), edge * (i >> 1 & 1), edge * (i >> 2));
    const TriangleMesh mesh = gaussian_surface(molecule_of(centers, std::vector<double>(8, 1.2)), with_spacing(0.5));
    EXPECT_THAT(mesh, IsClosedManifold()) << edge;
    EXPECT_EQ(count_self_intersections(mesh), 0U) << edge;
  }
}

TEST(GaussianSurface, FarFromTheOriginIsTheSameShape) {
  const std::vector<Vec3> centers = {{0, 0, 0}, {2.5, 0.4, 0}, {1, 2.2, 1.4}};
  const std::vector<double> radii = {1.7, 1.5, 1.2};
  const TriangleMesh near = gaussian_surface(molecule_of(centers, radii), {});
  std::vector<Vec3> moved;
  for (const Vec3& c : centers) moved.push_back(c + Vec3(1e5, -1e5, 1e5));
  const TriangleMesh far = gaussian_surface(molecule_of(moved, radii), {});
  EXPECT_THAT(far, IsClosedManifold());
  EXPECT_EQ(count_self_intersections(far), 0U);
  EXPECT_NEAR(enclosed_volume(far), enclosed_volume(near), 1e-6 * enclosed_volume(near));
  EXPECT_EQ(far.vertex_count(), near.vertex_count());
}

TEST(GaussianSurface, IsThatOfTheWholeGridWhereverItsBlocksEnd) {
  const Molecule molecule = testing::random_cluster(300, 5);
  const double spacing = 0.3;
  const GaussianField field(molecule, {0.6, 1e-6});
  ScalarGrid grid;
  grid.spacing = spacing;
  grid.origin = field.low() - Vec3::Constant(spacing);
  for (int axis = 0; axis < 3; ++axis)
    grid.size[axis] = static_cast<std::uint32_t>(std::ceil((field.high()[axis] - grid.origin[axis]) / spacing)) + 2;
  field.sample(grid);
  const TriangleMesh whole = trilinear_surface(grid, 1);
  const TriangleMesh mesh = gaussian_surface(molecule, with_spacing(spacing));
  EXPECT_GT(*std::max_element(grid.size.begin(), grid.size.end()), 70U);  // several blocks
  EXPECT_EQ(mesh.vertex_count(), whole.vertex_count());
  EXPECT_EQ(shape_of(mesh), shape_of(whole));
}

TEST(GaussianSurface, IsTheSameForAnyNumberOfThreads) {
  const Molecule molecule = testing::random_cluster(800, 6);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    GaussianSurfaceReport report;
    TriangleMesh mesh = gaussian_surface(molecule, with_spacing(0.35), &report);
    return std::tuple(std::move(mesh.points), std::move(mesh.triangles), report.surface_cells, report.interior_vertices);
  };
  const auto one = with_threads(1);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(with_threads(threads) == one) << threads << " threads";
}

/// Memory that `work` takes at its largest beyond what is in use before, MB.
template <class Work>
double peak_memory_mb_during(const Work& work) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew
  const double before = peak_memory_mb();
  work();
  return peak_memory_mb() - before;
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kMemoryIsMeasurable = false;
#else
constexpr bool kMemoryIsMeasurable = true;
#endif

TEST(GaussianSurface, OfAtomsFarApartTakesNextToNothing) {
  // The box would have 2.4e15 nodes.
  const Molecule molecule = molecule_of({{0, 0, 0}, {1e5, 1e5, 1e5}}, {kRadius, kRadius});
  TriangleMesh mesh;
  const double memory = peak_memory_mb_during([&] { mesh = gaussian_surface(molecule, {}); });
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(euler_characteristic(mesh), 4);
  EXPECT_NEAR(enclosed_volume(mesh), 2 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3), 4);
  if (kMemoryIsMeasurable) {
    EXPECT_LT(memory, 8);
  }
}

TEST(GaussianSurface, OfAHollowShellTakesMemoryForTheShell) {
  // Atoms 1.2 Å apart on a sphere of radius 150 Å: a box of 74 million nodes at 0.745 Å, 590 MB.
  constexpr int kAtoms = 200000;
  std::vector<Vec3> centers;
  for (int i = 0; i < kAtoms; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kAtoms;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    centers.emplace_back(150 * Vec3(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z));
  }
  const Molecule molecule = molecule_of(centers, std::vector<double>(kAtoms, 1.5));
  TriangleMesh mesh;
  GaussianSurfaceReport report;
  const double memory = peak_memory_mb_during([&] { mesh = gaussian_surface(molecule, {}, &report); });
  EXPECT_EQ(euler_characteristic(mesh), 4);  // outside and inside
  EXPECT_LT(report.grid_nodes, 40000000U);
  if (kMemoryIsMeasurable) {
    EXPECT_LT(memory, 250);
  }
}

TEST(GaussianSurface, NeedsTheMemoryThatIsEstimated) {
  const std::filesystem::path file = testing::apbs_molecule("misc/mache.pqr");
  if (file.empty()) GTEST_SKIP() << "apbs-data is not installed";
  if (!kMemoryIsMeasurable) GTEST_SKIP() << "the sanitizer takes memory too";
  const Molecule molecule = read_molecule(file);
  const GaussianField field(molecule, {0.6, 1e-6});
  for (const double spacing : {0.3, 0.745}) {
    const double estimate = bytes_to_mesh(field, estimated_vertices(field, {1, spacing})) / (1 << 20);
    const double measured = peak_memory_mb_during([&] { gaussian_surface(molecule, with_spacing(spacing)); });
    EXPECT_LT(measured, 1.5 * estimate) << spacing;
    EXPECT_GT(measured, estimate / 1.5) << spacing;
  }
}

TEST(GaussianSurface, RefusesToTakeMoreMemoryThanTheLimitAndSaysHowMuch) {
  const Molecule molecule = testing::random_cluster(2000, 7);
  GaussianSurfaceOptions options = with_spacing(0.05);
  options.max_memory_bytes = std::size_t{64} << 20;
  EXPECT_THAT([&] { gaussian_surface(molecule, options); },
              ThrowsMessage<InvalidInput>(
                  ::testing::ContainsRegex("some .* vertices and need some [0-9]+ MB of memory, more than the limit of 64 MB")));
  options.spacing = 0.745;  // whose bound from the atoms alone is above the limit, too
  EXPECT_GT(most_vertices(GaussianField(molecule, {}), {1, 0.745}), 8e5);
  EXPECT_NO_THROW(gaussian_surface(molecule, options));
}

TEST(GaussianSurface, RefusesMoreVerticesThanCanBeNumbered) {
  const Molecule molecule = testing::random_cluster(2000, 7);
  EXPECT_THAT([&] { gaussian_surface(molecule, with_spacing(1e-4)); },
              ThrowsMessage<InvalidInput>(HasSubstr("vertices, more than 32-bit indices can number")));
}

TEST(GaussianSurface, RefusesASpacingThatDoublesDoNotResolve) {
  const Molecule molecule = molecule_of({{1e9, 0, 0}}, {1});
  EXPECT_THAT([&] { gaussian_surface(molecule, {}); }, ThrowsMessage<InvalidInput>(HasSubstr("cannot be resolved")));
}

TEST(GaussianSurface, RefusesAnIsovalueThatIsNeverReachedAndNamesTheFieldsRange) {
  // Alone, an atom has its maximum e^(d·r²) at its centre.
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  GaussianSurfaceOptions options;
  options.isovalue = 5;
  EXPECT_THAT([&] { gaussian_surface(molecule, options); },
              ThrowsMessage<InvalidInput>(HasSubstr("never reaches the isovalue 5: it is between 0 and 1.82212")));
}

TEST(GaussianSurface, SaysWhenTheIsovalueIsReachedBetweenTheNodesOnly) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {0.3});
  EXPECT_THAT([&] { gaussian_surface(molecule, with_spacing(2)); },
              ThrowsMessage<InvalidInput>(HasSubstr("choose a smaller spacing than 2")));
  EXPECT_THAT(gaussian_surface(molecule, with_spacing(0.2)), IsClosedManifold());
}

TEST(GaussianSurface, StopsWhenTheCallbackSaysSo) {
  const Molecule molecule = testing::random_cluster(300, 8);
  for (const int calls : {0, 1, 5}) {
    int left = calls;
    EXPECT_THROW(gaussian_surface(molecule, with_spacing(0.3), nullptr, [&](auto, double) { return left-- > 0; }), Cancelled) << calls;
  }
}

TEST(GaussianSurface, ReportsItsProgressInOrderAndOneCallAtATime) {
  const Molecule molecule = testing::random_cluster(300, 8);
  double last = 0;
  int running = 0;
  bool was_in_order = true;
  bool was_alone = true;
  gaussian_surface(molecule, with_spacing(0.3), nullptr, [&](std::string_view, double fraction) {
    was_alone = was_alone && ++running == 1;
    was_in_order = was_in_order && fraction >= last && fraction <= 1;
    last = fraction;
    std::this_thread::yield();
    --running;
    return true;
  });
  EXPECT_TRUE(was_in_order);
  EXPECT_TRUE(was_alone);
  EXPECT_EQ(last, 1);
}

TEST(GaussianSurface, RefusesBadOptionsAndMolecules) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(gaussian_surface(molecule, {bad, 1, 0.745}), InvalidOption);
    EXPECT_THROW(gaussian_surface(molecule, {0.6, bad, 0.745}), InvalidOption);
    EXPECT_THROW(gaussian_surface(molecule, {0.6, 1, bad}), InvalidOption);
  }
  EXPECT_THROW(gaussian_surface(Molecule{}, {}), InvalidInput);
  EXPECT_THROW(gaussian_surface(molecule_of({{0, 0, 0}}, {-1}), {}), InvalidInput);
}

class GaussianSurfaceOfMolecule : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Apbs, GaussianSurfaceOfMolecule,
                         ::testing::Values("misc/mache.pqr", "misc/achbp.pqr", "misc/fas2.pqr", "actin-dimer/complex.pqr",
                                           "bem/test_proteins/1a63.pqr"));

TEST_P(GaussianSurfaceOfMolecule, IsSoundAndTheSameTwice) {
  const std::filesystem::path file = testing::apbs_molecule(GetParam());
  if (file.empty()) GTEST_SKIP() << "apbs-data is not installed";
  const Molecule molecule = read_molecule(file);
  GaussianSurfaceReport report;
  const TriangleMesh mesh = gaussian_surface(molecule, {}, &report);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(count_self_intersections(mesh), 0U);
  EXPECT_GT(enclosed_volume(mesh), 0);
  EXPECT_EQ(report.atoms, molecule.atom_count());
  EXPECT_LT(report.ambiguous_cells, report.surface_cells / 20);

  const TriangleMesh again = gaussian_surface(molecule, {});
  EXPECT_EQ(mesh.points, again.points);
  EXPECT_EQ(mesh.triangles, again.triangles);
}

class GaussianSurfaceOfLargeMolecule : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shared, GaussianSurfaceOfLargeMolecule, ::testing::Values("connexin_2zw3.pqr.gz", "amylase_vhh_1kxq.pqr.gz"));

TEST_P(GaussianSurfaceOfLargeMolecule, IsSoundFromBothSamplers) {
  const std::filesystem::path file = testing::shared_molecule(GetParam());
  if (file.empty()) GTEST_SKIP() << GetParam() << " is not there";
  const Molecule molecule = read_molecule(file);
  for (const double error : {0.0, 1.0}) {
    GaussianSurfaceOptions options;
    options.error = error;
    const TriangleMesh mesh = gaussian_surface(molecule, options);
    EXPECT_THAT(mesh, IsClosedManifold()) << error;
    EXPECT_EQ(count_self_intersections(mesh), 0U) << error;
    EXPECT_GT(enclosed_volume(mesh), 0) << error;
  }
}

TEST(GaussianSurface, OfTheAcheMonomerHasAsManyVerticesAsThePaperSays) {
  const std::filesystem::path file = testing::apbs_molecule("misc/mache.pqr");
  if (file.empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TriangleMesh mesh = gaussian_surface(read_molecule(file), {});
  EXPECT_GT(mesh.vertex_count(), 60000U);
  EXPECT_LT(mesh.vertex_count(), 75000U);
}

}  // namespace
}  // namespace smopt
