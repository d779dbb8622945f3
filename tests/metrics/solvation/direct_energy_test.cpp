#include "tests/metrics/solvation/direct_energy.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "smopt/error.h"
#include "tests/metrics/solvation/kirkwood.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 4 * kPi * 332.06;  ///< kcal/mol for e · e/Å in the kernels' units
constexpr DielectricSphere kSaltWater = {.inner = 2, .outer = 80, .kappa = 0.125714};
constexpr double kRadius = 5;

std::vector<PointCharge> three_charges() {
  return {{{1.5, 1.0, -0.5}, 1.0}, {{-1.25, 2.0, 1.4}, -0.7}, {{0.5, -1.75, 1.5}, 0.5}};
}

std::vector<SurfacePotential> exact_unknowns(const TriangleMesh& mesh, const DielectricSphere& medium,
                                             const std::vector<PointCharge>& charges) {
  std::vector<SurfacePotential> unknowns;
  for (const Vec3& p : mesh.points) unknowns.push_back(kirkwood_potential(kRadius, medium, charges, p));
  return unknowns;
}

/// Unknowns without any pattern; the same for the same seed.
std::vector<SurfacePotential> random_unknowns(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<SurfacePotential> unknowns;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) unknowns.push_back({uniform(random), uniform(random)});
  return unknowns;
}

double relative_error(int subdivisions, const DielectricSphere& medium, const std::vector<PointCharge>& charges) {
  const TriangleMesh mesh = icosphere(subdivisions, kRadius);
  return direct_polar_energy(mesh, medium, charges, exact_unknowns(mesh, medium, charges)) / kirkwood_energy(kRadius, medium, charges) - 1;
}

/// Flat triangles and linear unknowns: a mesh of half the edge length has a quarter of the error. For the three charges and 10 242 vertices
/// (edges of 0.03 radii) it is 4e-5 without salt and 1.6e-4 for κ = 1/Å.
TEST(DirectEnergy, TendsToKirkwoodAtSecondOrder) {
  const std::vector<PointCharge> off_centre = {{{0, 1, -2}, 1}};
  for (const double kappa : {0.0, 0.125714, 1.0}) {
    for (const auto& charges : {off_centre, three_charges()}) {
      const DielectricSphere medium = {2, 80, kappa};
      const double coarse = relative_error(3, medium, charges);
      const double middle = relative_error(4, medium, charges);
      const double fine = relative_error(5, medium, charges);
      EXPECT_NEAR(coarse / middle, 4, 0.05) << kappa;
      EXPECT_NEAR(middle / fine, 4, 0.015) << kappa;
      EXPECT_LT(std::abs(fine), 2e-4) << kappa;
      EXPECT_NEAR((4 * fine - middle) / 3, 0, 1e-6) << "Richardson's limit, " << kappa;
    }
  }
}

/// A Born ion without salt has a constant potential, and K1 is 0: the energy is the solid angle's and has no error of the mesh at all. With
/// salt it has, of second order again.
TEST(DirectEnergy, OfABornIonIsExactWithoutSalt) {
  const std::vector<PointCharge> central = {{Vec3::Zero(), 1}};
  EXPECT_NEAR(relative_error(3, {2, 80, 0}, central), 0, 1e-9);
  EXPECT_NEAR(relative_error(3, kSaltWater, central) / relative_error(4, kSaltWater, central), 4, 0.02);
}

/// ∫ ∂G0/∂ν dS = −1 round a charge, on any closed surface, and 0 round none: for φ = 1 and κ = 0 the energy is ½ · 4π · 332.06 q (1 − ε).
TEST(DirectEnergy, OfAConstantPotentialIsTheSolidAngle) {
  const DielectricSphere medium = {2, 80, 0};
  const TriangleMesh ball = noisy(icosphere(3, kRadius), 0.05, 3);
  const std::vector<SurfacePotential> ones(ball.vertex_count(), {1, 0.3});  // K1 is 0 without salt, whatever ∂φ/∂ν
  const std::vector<PointCharge> charges = {{{1, 2, -2}, 1.5}, {{0, 3, 6}, 7}};
  EXPECT_NEAR(direct_polar_energy(ball, medium, charges, ones) / (0.5 * kUnit * 1.5 * (1 - 40)), 1, 1e-8);
  EXPECT_NEAR(direct_polar_energy(reversed(ball), medium, charges, ones) / (0.5 * kUnit * 1.5 * (40 - 1)), 1, 1e-8) << "inside out";
}

/// Seen from the centre, K1 and K2 are constant on a sphere: ∫ K1 = a (1 − e^(−κa)), ∫ K2 = 1 − ε (1 + κa) e^(−κa).
TEST(DirectEnergy, HasTheSpheresAnalyticLayers) {
  const DielectricSphere medium = {.inner = 4, .outer = 10, .kappa = 0.3};
  const TriangleMesh ball = icosphere(5, kRadius);
  const std::vector<PointCharge> charge = {{Vec3::Zero(), 2}};
  const std::vector<SurfacePotential> single(ball.vertex_count(), {0, 1});
  const std::vector<SurfacePotential> layer(ball.vertex_count(), {1, 0});
  const double screening = std::exp(-0.3 * kRadius);
  EXPECT_NEAR(direct_polar_energy(ball, medium, charge, single) / (kUnit * kRadius * (1 - screening)), 1, 1e-3);
  EXPECT_NEAR(direct_polar_energy(ball, medium, charge, layer) / (kUnit * (1 - 2.5 * (1 + 0.3 * kRadius) * screening)), 1, 1e-3);
}

/// One triangle with different unknowns at its corners, against the centroids of 160 000 small ones with K2 by differences of the kernels.
TEST(DirectEnergy, AgreesWithABruteForceSumOverOneTriangle) {
  const TriangleMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0.2, 0.7, 0.4}}, {{0, 1, 2}}};
  const std::vector<SurfacePotential> unknowns = {{1, 0.2}, {-0.5, 2}, {0.3, -1.1}};
  const std::vector<PointCharge> charges = {{{-0.3, -0.6, 0.8}, 1.3}};
  const Vec3 a = mesh.points[0], b = mesh.points[1], c = mesh.points[2];
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const double area = (b - a).cross(c - a).norm() / 2;
  const auto kernel = [&](double kappa, const Vec3& y) {
    const double r = (y - charges[0].position).norm();
    return std::exp(-kappa * r) / (4 * kPi * r);
  };
  const auto slope = [&](double kappa, const Vec3& y) {
    return (kernel(kappa, y + 1e-5 * normal) - kernel(kappa, y - 1e-5 * normal)) / 2e-5;
  };
  constexpr int kParts = 400;
  double sum = 0;
  const auto add = [&](double u, double v) {
    const Vec3 y = a + u * (b - a) + v * (c - a);
    const double potential = 1 - 1.5 * u - 0.7 * v;
    const double derivative = 0.2 + 1.8 * u - 1.3 * v;
    sum += (kernel(0, y) - kernel(0.4, y)) * derivative + (5 * slope(0.4, y) - slope(0, y)) * potential;
  };
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; i + j < kParts; ++j) {
      add((i + 1.0 / 3) / kParts, (j + 1.0 / 3) / kParts);
      if (i + j < kParts - 1) add((i + 2.0 / 3) / kParts, (j + 2.0 / 3) / kParts);
    }
  }
  const double expected = 0.5 * kUnit * 1.3 * sum * area / (kParts * kParts);
  EXPECT_NEAR(direct_polar_energy(mesh, {.inner = 2, .outer = 10, .kappa = 0.4}, charges, unknowns) / expected, 1, 1e-5);
}

TEST(DirectEnergy, DoesNotDependOnWhereACornerListStarts) {
  const TriangleMesh mesh = noisy(icosphere(1, kRadius), 0.2, 11);
  TriangleMesh turned = mesh;
  for (Triangle& t : turned.triangles) t = {t[1], t[2], t[0]};
  const std::vector<SurfacePotential> unknowns = random_unknowns(mesh, 12);
  const double energy = direct_polar_energy(mesh, kSaltWater, three_charges(), unknowns);
  EXPECT_NEAR(direct_polar_energy(turned, kSaltWater, three_charges(), unknowns) / energy, 1, 1e-13);
}

TEST(DirectEnergy, DoesNotChangeUnderRigidMotion) {
  const TriangleMesh mesh = noisy(icosphere(1, kRadius), 0.2, 11);
  const std::vector<SurfacePotential> unknowns = random_unknowns(mesh, 12);
  const Vec3 axis(1, -2, 0.5), shift(10, 20, -30);
  std::vector<PointCharge> charges = three_charges();
  const double energy = direct_polar_energy(mesh, kSaltWater, charges, unknowns);
  for (PointCharge& c : charges) c.position = Eigen::AngleAxisd(0.8, axis.normalized()) * c.position + shift;
  EXPECT_NEAR(direct_polar_energy(translated(rotated(mesh, axis, 0.8), shift), kSaltWater, charges, unknowns) / energy, 1, 1e-12);
}

TEST(DirectEnergy, IgnoresTrianglesWithoutArea) {
  TriangleMesh mesh = icosphere(1, kRadius);
  const std::vector<SurfacePotential> unknowns = random_unknowns(mesh, 5);
  const double energy = direct_polar_energy(mesh, kSaltWater, three_charges(), unknowns);
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(direct_polar_energy(mesh, kSaltWater, three_charges(), unknowns), energy);
}

TEST(DirectEnergy, RefusesTooFewUnknowns) {
  EXPECT_THROW(direct_polar_energy(cube(), kSaltWater, three_charges(), std::vector<SurfacePotential>(7)), InvalidInput);
}

}  // namespace
}  // namespace smopt::testing
