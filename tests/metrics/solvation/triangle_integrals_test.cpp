#include "metrics/solvation/triangle_integrals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace smopt::metrics {
namespace {

constexpr KernelParameters kWater = {0.125714, 40};

/// The kernels by their textbook formulas, in long double: no differences are taken with care.
struct PlainKernels {
  long double k1, k2, k3, k4, double_layer;
};

PlainKernels plain_kernels(const Vec3& rho, const Vec3& n, const Vec3& nu, const KernelParameters& parameters) {
  const long double r = std::sqrt(static_cast<long double>(rho.squaredNorm()));
  const long double kappa = parameters.kappa, epsilon = parameters.ratio;
  const long double n_e = n.dot(rho) / r, nu_e = nu.dot(rho) / r, n_nu = n.dot(nu);
  struct Derivatives {
    long double g, along_nu, along_n, along_both;
  };
  const auto of = [&](long double k) {
    const long double g = std::exp(-k * r) / (4 * std::numbers::pi_v<long double> * r);
    const long double dg = -g * (k + 1 / r);
    const long double ddg = g * (k * k + 2 * k / r + 2 / (r * r));
    return Derivatives{g, -dg * nu_e, dg * n_e, -(ddg * n_e * nu_e + dg / r * (n_nu - n_e * nu_e))};
  };
  const Derivatives plain = of(0), screened = of(kappa);
  return {plain.g - screened.g, epsilon * screened.along_nu - plain.along_nu, plain.along_n - screened.along_n / epsilon,
          screened.along_both - plain.along_both, plain.along_nu};
}

TEST(Kernels, AreTheirFormulasWhereThoseLoseNoDigits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double scale : {0.3, 1.0, 10.0}) {
    for (int i = 0; i < 20; ++i) {
      const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
      const Vec3 rho = scale * vector(), n = vector().normalized(), nu = vector().normalized();
      const PlainKernels expected = plain_kernels(rho, n, nu, kWater);
      const KernelValues sample = kernel_values(rho, n, nu, kWater);
      const auto near = [](double value, long double exact, long double scale_of) {
        EXPECT_NEAR(value, static_cast<double>(exact), 1e-12 * static_cast<double>(scale_of));
      };
      const long double r = rho.norm();
      near(sample.k1, expected.k1, 1 / r);
      near(sample.k2, expected.k2, 40 / (r * r));
      near(sample.k3, expected.k3, 1 / (r * r));
      near(sample.k4, expected.k4, 1 / (r * r * r));
      near(sample.double_layer, expected.double_layer, 1 / (r * r));
    }
  }
}

/// At a millionth of an ångström textbook differences have no digit left; their limits are known.
TEST(Kernels, KeepTheirDigitsAtTinyDistances) {
  const double r = 1e-6, kappa = kWater.kappa;
  const Vec3 e = Vec3(1, 2, -2) / 3, n = Vec3(2, 1, 2) / 3;
  const KernelValues sample = kernel_values(r * e, n, n, kWater);
  EXPECT_NEAR(sample.k1 * 4 * std::numbers::pi / kappa, 1, 1e-6);
  // K4 -> -κ²/(8πr)·(n·ν - (n·e)(ν·e)).
  const double expected = -kappa * kappa / (8 * std::numbers::pi * r) * (1 - n.dot(e) * n.dot(e));
  EXPECT_NEAR(sample.k4 / expected, 1, 1e-6);
}

TEST(Kernels, SeriesAndFormulaOfTheDefectsMeet) {
  const ScreeningDefects below = screening_defects(0.3 - 1e-12), above = screening_defects(0.3);
  EXPECT_NEAR(below.first / above.first, 1, 1e-10);
  EXPECT_NEAR(below.second / above.second, 1, 1e-10);
}

/// Signed solid angle by 4π (Van Oosterom & Strackee 1983), positive where the normal points away from x.
double solid_angle(const Vec3& x, const std::array<Vec3, 3>& corners) {
  const Vec3 a = corners[0] - x, b = corners[1] - x, c = corners[2] - x;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb) / (4 * std::numbers::pi);
}

KernelValues whole(const CornerIntegrals& integrals) {
  KernelValues sum;
  for (const KernelValues& corner : integrals) sum.add(corner);
  return sum;
}

const std::array<Vec3, 3> kTriangle = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.8, 0)};
const std::array<Vec3, 3> kNeedle = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.7, 1e-3, 0)};

/// ∫ ∂G0/∂ν is minus the solid angle, however close the target is.
TEST(TriangleIntegrals, DoubleLayerIsTheSolidAngle) {
  for (const auto& triangle : {kTriangle, kNeedle}) {
    for (const double height : {3.0, 0.3, 0.03, 1e-4, 1e-10, -1e-4, -0.3}) {
      for (const Vec3& foot : {Vec3(0.4, 0.2, 0), Vec3(0.5, 0, 0), Vec3(-0.2, 0.5, 0), Vec3(0.7, 5e-4, 0)}) {
        const Vec3 x = foot + Vec3(0, 0, height);
        const double exact = -solid_angle(x, triangle);
        EXPECT_NEAR(whole(integrate({x, Vec3::Zero()}, triangle, {}, kWater, {})).double_layer, exact, 1e-4)
            << height << ' ' << foot.transpose();
        EXPECT_NEAR(whole(integrate({x, Vec3::Zero()}, triangle, {}, kWater, {0.3})).double_layer, exact, 1e-7)
            << height << ' ' << foot.transpose();
      }
    }
  }
}

TEST(TriangleIntegrals, FinerPiecesChangeLittle) {
  const TargetPoint target = {{0.4, 0.3, 0.05}, Vec3(1, 2, 3).normalized()};
  const CornerIntegrals coarse = integrate(target, kTriangle, {}, kWater, {1});
  const CornerIntegrals fine = integrate(target, kTriangle, {}, kWater, {0.1});
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(coarse[c].k1, fine[c].k1, 1e-6);
    EXPECT_NEAR(coarse[c].k2, fine[c].k2, 1e-4 * 40);
    EXPECT_NEAR(coarse[c].k3, fine[c].k3, 1e-4);
    EXPECT_NEAR(coarse[c].k4, fine[c].k4, 1e-4);
  }
}

TEST(TriangleIntegrals, ATargetOnTheTriangleGetsThePrincipalValue) {
  const CornerIntegrals integrals = integrate({{0.4, 0.2, 0}, Vec3::UnitX()}, kTriangle, {}, kWater, {});
  EXPECT_NEAR(whole(integrals).double_layer, 0, 1e-12);
  EXPECT_TRUE(std::isfinite(whole(integrals).k3));
}

/// At a corner, against the other way: a target that comes ever nearer to it along the plane, where ∂G0/∂ν is 0 too.
TEST(TriangleIntegrals, CornersAreTheLimitOfTargetsBesideThem) {
  const Vec3 normal = Vec3::UnitZ();
  const CornerIntegrals at = integrate_at_corner({kTriangle[0], normal}, kTriangle, {}, kWater, {});
  const CornerIntegrals beside = integrate({{-1e-6, -1e-6, 0}, normal}, kTriangle, {}, kWater, {0.3});
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(at[c].k1, beside[c].k1, 1e-6 * std::abs(beside[c].k1));
    EXPECT_NEAR(at[c].k4, beside[c].k4, 1e-4 * std::abs(beside[c].k4));
    EXPECT_EQ(at[c].k2, 0);
    EXPECT_EQ(at[c].double_layer, 0);
  }
}

/// ∫ 1/r over a triangle from its corner x is h·[asinh(tan)] between the angles at the foot of the height h on the opposite side.
TEST(TriangleIntegrals, InverseDistanceFromACornerIsTheAnalyticOne) {
  const double kappa = 1e-5;  // K4 = -κ²/(8πr) for a normal along the triangle's, K1 = κ/4π
  for (const auto& triangle : {kTriangle, kNeedle}) {
    const Vec3 side = (triangle[2] - triangle[1]).normalized();
    const double from = (triangle[1] - triangle[0]).dot(side), to = (triangle[2] - triangle[0]).dot(side);
    const double height = (triangle[1] - triangle[0] - from * side).norm();
    const double exact = height * (std::asinh(to / height) - std::asinh(from / height));
    const KernelValues sum = whole(integrate_at_corner({triangle[0], Vec3::UnitZ()}, triangle, {}, {kappa, 40}, {}));
    EXPECT_NEAR(sum.k4 * -8 * std::numbers::pi / (kappa * kappa), exact, 1e-4 * exact);
  }
}

/// On a sphere of radius R the height at distance r is -r²/(2R), so that K3 is -(1 - 1/ε)/(8πR·r): the same integral.
TEST(TriangleIntegrals, HeightsGiveTheNormalDerivativeOfACurvedSurface) {
  const double radius = 100;
  const auto height = [&](const Vec3& from, const Vec3& to) { return -(to - from).squaredNorm() / (2 * radius); };
  const SideHeights heights = {height(kTriangle[0], kTriangle[1]), height(kTriangle[1], kTriangle[2]), height(kTriangle[2], kTriangle[0])};
  const Vec3 side = (kTriangle[2] - kTriangle[1]).normalized();
  const double from = (kTriangle[1] - kTriangle[0]).dot(side), to = (kTriangle[2] - kTriangle[0]).dot(side);
  const double h = (kTriangle[1] - kTriangle[0] - from * side).norm();
  const double inverse_distance = h * (std::asinh(to / h) - std::asinh(from / h));
  const KernelValues sum = whole(integrate_at_corner({kTriangle[0], Vec3::UnitZ()}, kTriangle, heights, {0, 40}, {}));
  const double exact = -(1 - 1.0 / 40) / (8 * std::numbers::pi * radius) * inverse_distance;
  EXPECT_NEAR(sum.k3, exact, 1e-4 * std::abs(exact));
}

/// A flat triangle hides that the sphere rises above it; with the heights K3 is that of the triangle of four times as many, corners on the sphere.
TEST(TriangleIntegrals, HeightsLiftATriangleOntoItsSphere) {
  const double radius = 10;
  const auto on_sphere = [&](double x, double y) { return Vec3(x, y, std::sqrt(radius * radius - x * x - y * y)); };
  const TargetPoint target = {on_sphere(0, 0), Vec3::UnitZ()};
  const std::array<Vec3, 3> corners = {on_sphere(1, 0), on_sphere(2, 0), on_sphere(1.5, 0.9)};
  const auto height = [&](const Vec3& from, const Vec3& to) { return -(to - from).squaredNorm() / (2 * radius); };
  const SideHeights heights = {height(corners[0], corners[1]), height(corners[1], corners[2]), height(corners[2], corners[0])};
  const auto k3 = [&](const std::array<Vec3, 3>& triangle, const SideHeights& h) {
    return whole(integrate(target, triangle, h, kWater, {})).k3;
  };
  // Each side cut into 16, and the points put onto the sphere.
  constexpr int kParts = 16;
  const auto at = [&](int i, int j) {
    const Vec3 flat = corners[0] + (corners[1] - corners[0]) * i / kParts + (corners[2] - corners[0]) * j / kParts;
    return Vec3(flat * (radius / flat.norm()));
  };
  double curved = 0;
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      curved += k3({at(i, j), at(i + 1, j), at(i, j + 1)}, {});
      if (i + j + 1 < kParts) curved += k3({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, {});
    }
  EXPECT_GT(std::abs(k3(corners, {}) / curved - 1), 0.05);
  EXPECT_NEAR(k3(corners, heights) / curved, 1, 0.01);
}

TEST(TriangleIntegrals, ATriangleWithoutAreaGivesNothing) {
  const std::array<Vec3, 3> flat = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0, 0)};
  EXPECT_EQ(whole(integrate({{0, 0, 1}, Vec3::UnitX()}, flat, {}, kWater, {})).k1, 0);
  EXPECT_EQ(whole(integrate_at_corner({flat[0], Vec3::UnitZ()}, flat, {}, kWater, {})).k1, 0);
}

}  // namespace
}  // namespace smopt::metrics
