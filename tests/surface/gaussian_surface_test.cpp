#include "smopt/surface/gaussian_surface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/surface/self_intersections.h"

namespace smopt {
namespace {

using testing::count_self_intersections;
using testing::enclosed_volume;
using testing::euler_characteristic;
using ::testing::HasSubstr;
using testing::IsClosedManifold;
using testing::surface_area;
using ::testing::ThrowsMessage;

Molecule molecule_of(std::vector<Vec3> centers, std::vector<double> radii) {
  const std::size_t n = centers.size();
  return {std::move(centers), std::vector<double>(n, 0.0), std::move(radii)};
}

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

TEST(GaussianSurface, RefusesAnIsovalueThatIsNeverReachedAndNamesTheMaximum) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  GaussianSurfaceOptions options;
  options.isovalue = 5;
  EXPECT_THAT([&] { gaussian_surface(molecule, options); },
              ThrowsMessage<InvalidInput>(HasSubstr("never reaches the isovalue 5: its maximum")));
}

TEST(GaussianSurface, RefusesBadOptionsAndMolecules) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(gaussian_surface(molecule, {bad, 1, 0.745}), InvalidOption);
    EXPECT_THROW(gaussian_surface(molecule, {0.6, bad, 0.745}), InvalidOption);
    EXPECT_THROW(gaussian_surface(molecule, {0.6, 1, bad}), InvalidOption);
  }
  EXPECT_THROW(gaussian_surface({}, {}), InvalidInput);
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

TEST(GaussianSurface, OfTheAcheMonomerHasAsManyVerticesAsThePaperSays) {
  const std::filesystem::path file = testing::apbs_molecule("misc/mache.pqr");
  if (file.empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TriangleMesh mesh = gaussian_surface(read_molecule(file), {});
  EXPECT_GT(mesh.vertex_count(), 60000U);
  EXPECT_LT(mesh.vertex_count(), 75000U);
}

}  // namespace
}  // namespace smopt
