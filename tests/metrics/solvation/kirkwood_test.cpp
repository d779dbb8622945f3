#include "tests/metrics/solvation/kirkwood.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "smopt/error.h"

namespace smopt::testing {
namespace {

constexpr double kPi = std::numbers::pi;

/// AFMPB's medium (150 mM at 300 K), and the same without salt.
constexpr DielectricSphere kSaltWater = {.inner = 2, .outer = 80, .kappa = 0.125714};
constexpr DielectricSphere kPureWater = {.inner = 2, .outer = 80, .kappa = 0};

/// Three charges of both signs, off the centre by up to 0.55 radii, in no plane with the origin.
std::vector<PointCharge> three_charges(double radius) {
  return {{radius * Vec3(0.3, 0.2, -0.1), 1.0}, {radius * Vec3(-0.25, 0.4, 0.28), -0.7}, {radius * Vec3(0.1, -0.35, 0.3), 0.5}};
}

struct Case {
  std::string name;
  double radius;
  DielectricSphere medium;
  std::vector<PointCharge> charges;
};

std::vector<Case> all_cases() {
  return {{"salt water", 5, kSaltWater, three_charges(5)},
          {"pure water", 5, kPureWater, three_charges(5)},
          {"large sphere, short Debye length", 20, {4, 78.5, 0.5}, three_charges(20)},
          {"weak contrast", 1, {3, 2, 1.5}, three_charges(1)},
          {"one charge, and none at the centre", 2, kSaltWater, {{{0, 0.8, 0.9}, -1}, {{0, 0, 0}, 0}}}};
}

double coulomb(const Case& c, const Vec3& x) {
  double sum = 0;
  for (const auto& [position, charge] : c.charges) sum += charge / (4 * kPi * c.medium.inner * (x - position).norm());
  return sum;
}

/// Nodes and weights of Gauss and Legendre on [−1, 1].
std::vector<std::array<double, 2>> gauss_legendre(unsigned n) {
  std::vector<std::array<double, 2>> rule;
  for (unsigned i = 0; i < n; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (n + 0.5));
    double slope = 0;
    for (int step = 0; step < 20; ++step) {
      slope = n * (x * std::legendre(n, x) - std::legendre(n - 1, x)) / (x * x - 1);
      x -= std::legendre(n, x) / slope;
    }
    rule.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

/// The sphere with its surface unknowns, for integrals over it: exact for spherical harmonics of degree below 120, so that kernels of
/// points within 0.6 radii, and beyond two, are integrated to rounding.
class SurfaceIntegral {
 public:
  explicit SurfaceIntegral(const Case& c) {
    constexpr unsigned kLatitudes = 60;
    constexpr unsigned kLongitudes = 2 * kLatitudes;
    for (const auto& [z, weight] : gauss_legendre(kLatitudes)) {
      for (unsigned j = 0; j < kLongitudes; ++j) {
        const double angle = 2 * kPi * j / kLongitudes;
        const Vec3 normal(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
        const SurfacePotential unknowns = kirkwood_potential(c.radius, c.medium, c.charges, c.radius * normal);
        nodes_.push_back({c.radius * normal, normal, weight * c.radius * c.radius * 2 * kPi / kLongitudes, unknowns});
      }
    }
  }

  struct Node {
    Vec3 point;
    Vec3 normal;
    double area;
    SurfacePotential unknowns;
  };

  [[nodiscard]] double of(const std::function<double(const Node&)>& integrand) const {
    double sum = 0;
    for (const Node& node : nodes_) sum += node.area * integrand(node);
    return sum;
  }

  /// ∫ [G ∂φ/∂ν · single + φ ∂G/∂ν · layer] with G = e^(−κr)/(4πr) between x and the surface.
  [[nodiscard]] double layers(const Vec3& x, double kappa, double single, double layer) const {
    return of([&](const Node& node) {
      const Vec3 d = node.point - x;
      const double r = d.norm();
      const double g = std::exp(-kappa * r) / (4 * kPi * r);
      const double g_normal = -(kappa + 1 / r) * g * d.dot(node.normal) / r;
      return single * g * node.unknowns.normal_derivative + layer * g_normal * node.unknowns.potential;
    });
  }

 private:
  std::vector<Node> nodes_;
};

/// Some points at that distance from the centre.
std::vector<Vec3> points_at(double distance) {
  std::vector<Vec3> points;
  for (const Vec3& d : {Vec3(1, 0, 0), Vec3(-1, 2, 3), Vec3(2, 1, -2), Vec3(-3, -1, 0.5)}) points.emplace_back(distance * d.normalized());
  return points;
}

/// f'(0) from f at 0, h, 2h, 3h, 4h; the error is h⁴/5 of the fifth derivative.
double one_sided_derivative(const std::function<double(double)>& f, double h) {
  return (-25 * f(0) + 48 * f(h) - 36 * f(2 * h) + 16 * f(3 * h) - 3 * f(4 * h)) / (12 * h);
}

TEST(Born, IsTheEnergyWorkedOutByHand) {
  EXPECT_NEAR(born_energy(1, 2, kPureWater), 83.015 * (1.0 / 80 - 1.0 / 2), 1e-10);              // 332.06/(2·2) = 83.015
  EXPECT_NEAR(born_energy(-2, 2, {.inner = 2, .outer = 80, .kappa = 0.5}), -163.954625, 1e-10);  // 1 + κa = 2: 4 · 83.015 · (1/160 − 1/2)
  EXPECT_NEAR(born_energy(1, 1, {.inner = 1, .outer = 1, .kappa = 1}), -83.015, 1e-10);          // only the salt: 166.03 · (1/2 − 1)
}

TEST(Kirkwood, OfACentralChargeIsBorn) {
  for (const double kappa : {0.0, 1e-6, 0.125714, 1.0, 30.0}) {
    const DielectricSphere medium = {.inner = 2, .outer = 80, .kappa = kappa};
    const std::vector<PointCharge> charges = {{Vec3::Zero(), -1.5}};
    EXPECT_NEAR(kirkwood_energy(3, medium, charges) / born_energy(-1.5, 3, medium), 1, 1e-14) << kappa;
  }
}

TEST(Kirkwood, PotentialOfACentralChargeIsWorkedOutByHand) {
  for (const double kappa : {0.0, 0.125714, 1.0}) {
    const std::vector<PointCharge> charges = {{Vec3::Zero(), -1.5}};
    const SurfacePotential got = kirkwood_potential(3, {2, 80, kappa}, charges, {0, 1.8, -2.4});
    EXPECT_NEAR(got.potential / (-1.5 / (4 * kPi * 80 * 3 * (1 + 3 * kappa))), 1, 1e-14);  // what the ion's screened potential is at r = a
    EXPECT_NEAR(got.normal_derivative / (1.5 / (4 * kPi * 2 * 9)), 1, 1e-14);              // Gauss
  }
}

TEST(Kirkwood, IsZeroWithoutContrastAndSalt) {
  EXPECT_EQ(kirkwood_energy(5, {.inner = 4, .outer = 4, .kappa = 0}, three_charges(5)), 0);
  EXPECT_LT(kirkwood_energy(5, {.inner = 4, .outer = 4, .kappa = 0.1}, three_charges(5)), -1e-3);
  EXPECT_EQ(kirkwood_energy(5, kSaltWater, {}), 0);
  EXPECT_GT(kirkwood_energy(5, {.inner = 80, .outer = 2, .kappa = 0}, three_charges(5)), 1e-3) << "charges avoid the worse medium";
}

/// For small κ only the total charge Q sees the salt: E(κ) − E(0) → −332.06 Q² κ/(2 ε_out), Debye and Hückel's limiting law.
TEST(Kirkwood, TendsToTheLimitingLawForLittleSalt) {
  const double without = kirkwood_energy(5, kPureWater, three_charges(5));
  for (const double kappa : {1e-4, 1e-5, 1e-6}) {
    const double with = kirkwood_energy(5, {2, 80, kappa}, three_charges(5));
    EXPECT_NEAR((with - without) / (-332.06 * 0.8 * 0.8 * kappa / 160), 1, 10 * kappa + 1e-13 / kappa) << kappa;
  }
}

/// Inside a conductor, a charge q at x has the image −q a/|x| at a² x/|x|². Its potential at y is −q a/√(a⁴ − 2a² x·y + x² y²) over ε_in;
/// with the energy's half, one charge has E = −332.06 q² a/(2 ε_in (a² − x²)).
TEST(Kirkwood, TendsToImageChargesInAConductor) {
  constexpr double kRadius = 4;
  constexpr double kMetal = 1e13;
  for (const double kappa : {0.0, 0.3}) {
    for (const double distance : {0.0, 1.0, 3.0, 3.96}) {
      const std::vector<PointCharge> charges = {{distance * Vec3(2, -1, 2) / 3, 1.2}};
      const double exact = -332.06 * 1.2 * 1.2 * kRadius / (2 * 2 * (kRadius * kRadius - distance * distance));
      EXPECT_NEAR(kirkwood_energy(kRadius, {2, kMetal, kappa}, charges) / exact, 1, 1e-12) << distance;
    }
    double exact = 0;
    const std::vector<PointCharge> charges = three_charges(kRadius);
    for (const auto& [x, p] : charges)
      for (const auto& [y, q] : charges)
        exact -= 332.06 * p * q * kRadius / (4 * std::sqrt(256 - 32 * x.dot(y) + x.squaredNorm() * y.squaredNorm()));
    EXPECT_NEAR(kirkwood_energy(kRadius, {2, kMetal, kappa}, charges) / exact, 1, 1e-12);
  }
}

/// Onsager (1936): a dipole p in a cavity has −332.06 p²/a³ (ε − 1)/(2ε + 1)/ε_in; two opposite charges close together are one.
TEST(Kirkwood, OfASmallDipoleIsOnsager) {
  const std::vector<PointCharge> charges = {{{0, 0.01, 0}, 1}, {{0, -0.01, 0}, -1}};
  const double exact = -332.06 * 0.02 * 0.02 / 27 * 39 / 81 / 2;
  EXPECT_NEAR(kirkwood_energy(3, kPureWater, charges) / exact, 1, 1e-7);
}

TEST(Kirkwood, DoesNotChangeUnderRotation) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Case& c : all_cases()) {
    const Vec3 axis(uniform(random), uniform(random), uniform(random));
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(3 * uniform(random), axis.normalized()).toRotationMatrix();
    std::vector<PointCharge> turned = c.charges;
    for (PointCharge& charge : turned) charge.position = rotation * charge.position;
    EXPECT_NEAR(kirkwood_energy(c.radius, c.medium, turned) / kirkwood_energy(c.radius, c.medium, c.charges), 1, 1e-13) << c.name;
    for (const Vec3& x : points_at(c.radius)) {
      const SurfacePotential a = kirkwood_potential(c.radius, c.medium, c.charges, x);
      const SurfacePotential b = kirkwood_potential(c.radius, c.medium, turned, rotation * x);
      EXPECT_NEAR(b.potential, a.potential, 1e-13 * std::abs(coulomb(c, x))) << c.name;
      EXPECT_NEAR(b.normal_derivative, a.normal_derivative, 1e-13 * std::abs(a.normal_derivative)) << c.name;
    }
  }
}

/// Lengths times f and κ by f: the energy and φ by f, ∂φ/∂n by f².
TEST(Kirkwood, ScalesWithTheLength) {
  const double energy = kirkwood_energy(5, kSaltWater, three_charges(5));
  EXPECT_NEAR(kirkwood_energy(5000, {2, 80, kSaltWater.kappa / 1000}, three_charges(5000)) / energy, 1e-3, 1e-16);
  const SurfacePotential a = kirkwood_potential(5, kSaltWater, three_charges(5), {0, 3, 4});
  const SurfacePotential b = kirkwood_potential(5000, {2, 80, kSaltWater.kappa / 1000}, three_charges(5000), {0, 3000, 4000});
  EXPECT_NEAR(b.potential / a.potential, 1e-3, 1e-16);
  EXPECT_NEAR(b.normal_derivative / a.normal_derivative, 1e-6, 1e-19);
}

TEST(Kirkwood, IsSymmetricInTheCharges) {
  const std::vector<PointCharge> charges = three_charges(5);
  const double energy = kirkwood_energy(5, kSaltWater, charges);
  EXPECT_NEAR(kirkwood_energy(5, kSaltWater, std::vector{charges[2], charges[0], charges[1]}) / energy, 1, 1e-14);
  // Reciprocity: what one charge's reaction field does to another is what the other's does to it.
  const double forth = kirkwood_reaction_potential(5, kSaltWater, std::vector{PointCharge{charges[0].position, 1}}, charges[1].position);
  const double back = kirkwood_reaction_potential(5, kSaltWater, std::vector{PointCharge{charges[1].position, 1}}, charges[0].position);
  EXPECT_NEAR(forth / back, 1, 1e-14);
}

TEST(Kirkwood, IsQuadraticInTheCharges) {
  const auto energy = [](double p, double q) {
    std::vector<PointCharge> charges = three_charges(5);
    charges[0].charge = p;
    charges[1].charge = q;
    charges[2].charge = 0;
    return kirkwood_energy(5, kSaltWater, charges);
  };
  EXPECT_NEAR(energy(-3, 6) / energy(1, -2), 9, 1e-12);
  EXPECT_NEAR((energy(1, 1) + energy(1, -1)) / (2 * energy(1, 0) + 2 * energy(0, 1)), 1, 1e-13) << "parallelogram law";
}

TEST(Kirkwood, MergesChargesAtOnePlace) {
  const Vec3 place(1, 2, -2);
  const std::vector<PointCharge> apart = {{place, 0.25}, {place, 0.5}};
  const std::vector<PointCharge> together = {{place, 0.75}};
  EXPECT_NEAR(kirkwood_energy(5, kSaltWater, apart) / kirkwood_energy(5, kSaltWater, together), 1, 1e-14);
}

/// Continuity of φ and of ε ∂φ/∂n between what the interior, the exterior and the surface functions say.
TEST(Kirkwood, PotentialMeetsBothTransmissionConditions) {
  for (const Case& c : all_cases()) {
    for (const Vec3& x : points_at(c.radius)) {
      const auto inside = [&](double depth) {
        const Vec3 y = x * (1 - depth);
        return coulomb(c, y) + kirkwood_reaction_potential(c.radius, c.medium, c.charges, y);
      };
      const auto outside = [&](double height) { return kirkwood_exterior_potential(c.radius, c.medium, c.charges, x * (1 + height)); };
      const SurfacePotential at = kirkwood_potential(c.radius, c.medium, c.charges, x);
      const double scale = std::abs(coulomb(c, x));
      EXPECT_NEAR(inside(0), at.potential, 1e-13 * scale) << c.name;
      EXPECT_NEAR(outside(0), at.potential, 1e-13 * scale) << c.name;
      const double inner_slope = -one_sided_derivative(inside, 5e-4) / c.radius;
      const double outer_slope = one_sided_derivative(outside, 5e-4) / c.radius;
      EXPECT_NEAR(inner_slope, at.normal_derivative, 1e-8 * scale / c.radius) << c.name;
      EXPECT_NEAR(c.medium.outer * outer_slope, c.medium.inner * at.normal_derivative, 1e-7 * scale / c.radius) << c.name;
    }
  }
}

/// Green's third identity for the Laplace equation, at points outside: the surface unknowns belong to a potential of just these charges
/// inside.
TEST(Kirkwood, SurfacePotentialSolvesThePoissonEquationInside) {
  for (const Case& c : all_cases()) {
    const SurfaceIntegral surface(c);
    for (const Vec3& x : points_at(2 * c.radius))
      EXPECT_NEAR(surface.layers(x, 0, -1, 1), coulomb(c, x), 1e-13 * std::abs(coulomb(c, x)) + 1e-15) << c.name;
  }
}

/// The same for the screened equation, at points inside, with φ of the outer side: the unknowns belong to a potential that decays outside.
TEST(Kirkwood, SurfacePotentialSolvesTheScreenedEquationOutside) {
  for (const Case& c : all_cases()) {
    const SurfaceIntegral surface(c);
    const double ratio = c.medium.outer / c.medium.inner;
    for (const Vec3& x : points_at(c.radius / 2)) {
      const double size = std::abs(surface.of([&](const auto& node) { return std::abs(node.unknowns.potential) * node.area; }));
      EXPECT_NEAR(surface.layers(x, c.medium.kappa, -1 / ratio, 1), 0, 1e-13 * size) << c.name;
    }
    for (const Vec3& x : points_at(2 * c.radius)) {
      const double outside = kirkwood_exterior_potential(c.radius, c.medium, c.charges, x);
      EXPECT_NEAR(surface.layers(x, c.medium.kappa, -1 / ratio, 1), outside, 1e-12 * std::abs(coulomb(c, x))) << c.name;
    }
  }
}

/// The reaction field at the charges comes from the surface unknowns by Juffer's representation, the formula that a solver uses.
TEST(Kirkwood, EnergyIsHalfTheReactionPotentialAtTheCharges) {
  for (const Case& c : all_cases()) {
    const SurfaceIntegral surface(c);
    const double ratio = c.medium.outer / c.medium.inner;
    double sum = 0;
    for (const auto& [x, charge] : c.charges) {
      const double reaction = surface.layers(x, 0, 1, -1) + surface.layers(x, c.medium.kappa, -1, ratio);
      EXPECT_NEAR(kirkwood_reaction_potential(c.radius, c.medium, c.charges, x) / reaction, 1, 1e-11) << c.name;
      sum += charge * reaction;
    }
    EXPECT_NEAR(kirkwood_energy(c.radius, c.medium, c.charges) / (4 * kPi * 332.06 / 2 * sum), 1, 1e-11) << c.name;
  }
}

/// Many terms: a charge below the surface sees a plane, and its image in it. E = 332.06 q²/(4 ε_in d) (1 − ε)/(1 + ε) for the depth d ≪ a.
TEST(Kirkwood, OfAChargeNearTheSurfaceIsThePlanesImage) {
  const std::vector<PointCharge> charges = {{{0, 0, 999.9}, 1}};
  EXPECT_NEAR(kirkwood_energy(1000, kPureWater, charges) / (332.06 / (4 * 2 * 0.1) * (1 - 40.0) / (1 + 40.0)), 1, 1e-4);
}

TEST(Kirkwood, RefusesWhatIsNotInTheSphere) {
  const std::vector<PointCharge> on = {{{0, 0, 5}, 1}};
  const std::vector<PointCharge> hardly_inside = {{{0, 0, 4.9999}, 1}};
  const std::vector<PointCharge> nowhere = {{{0, 0, std::nan("")}, 1}};
  const std::vector<PointCharge> inside = three_charges(5);
  EXPECT_THROW(kirkwood_energy(5, kSaltWater, on), InvalidInput);
  EXPECT_THROW(kirkwood_energy(5, kSaltWater, hardly_inside), InvalidInput);
  EXPECT_THROW(kirkwood_energy(5, kSaltWater, nowhere), InvalidInput);
  EXPECT_THROW(kirkwood_energy(-5, kSaltWater, {}), InvalidInput);
  EXPECT_THROW(kirkwood_energy(5, {2, 80, -0.1}, inside), InvalidInput);
  EXPECT_THROW(kirkwood_energy(5, {0, 80, 0.1}, inside), InvalidInput);
  EXPECT_THROW(kirkwood_potential(5, kSaltWater, inside, {0, 0, 5.01}), InvalidInput);
  EXPECT_THROW(kirkwood_potential(5, kSaltWater, inside, {0, 0, 0}), InvalidInput);
  EXPECT_THROW(kirkwood_reaction_potential(5, kSaltWater, inside, {0, 0, 6}), InvalidInput);
  EXPECT_THROW(kirkwood_exterior_potential(5, kSaltWater, inside, {0, 0, 4}), InvalidInput);
  EXPECT_THROW(born_energy(1, 0, kSaltWater), InvalidInput);
  EXPECT_NO_THROW(kirkwood_potential(5, kSaltWater, inside, {0, 0, 5.000004})) << "six digits in a file";
}

/// k_n(z) = √(2/(πz)) K_(n+½)(z), from the standard library.
TEST(SphericalBessel, IsTheStandardLibrarysFunction) {
  for (const double z : {0.01, 0.5, 3.0, 40.0}) {
    const std::vector<long double> k = scaled_spherical_k(31, z);
    double double_factorial = 1;  // (2n − 1)!!
    for (int n = 0; n <= 30; ++n) {
      const double expected = std::sqrt(2 / (kPi * z)) * std::cyl_bessel_k(n + 0.5, z) * std::exp(z) * std::pow(z, n + 1);
      EXPECT_NEAR(static_cast<double>(k[n]) * double_factorial / expected, 1, 1e-12) << n << ' ' << z;
      double_factorial *= 2 * n + 1;
    }
  }
}

/// They rise with n to e^z, which they reach but for z²/(4n).
TEST(SphericalBessel, StaysBetweenItsLimits) {
  for (const long double value : scaled_spherical_k(20, 0)) EXPECT_EQ(value, 1);
  for (const long double z : {0.1L, 1.0L, 10.0L, 500.0L}) {
    const std::vector<long double> k = scaled_spherical_k(100000, z);
    EXPECT_EQ(k.front(), 1);
    EXPECT_TRUE(std::is_sorted(k.begin(), k.end())) << static_cast<double>(z);
    const long double missing = 1 - k.back() / std::exp(z);
    EXPECT_NEAR(static_cast<double>(missing / (z * z / 4e5L)), 1, 0.001 + static_cast<double>(z * z) / 4e5) << static_cast<double>(z);
  }
  EXPECT_EQ(scaled_spherical_k(1, 2).size(), 1U);
}

}  // namespace
}  // namespace smopt::testing
