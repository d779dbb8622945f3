#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "smopt/geometry/vec3.h"

/// The kernels of the derivative boundary integral equations (Juffer et al. 1991, J. Comput. Phys. 97:144), in differences that lose no digits where
/// the target is close to the source.
namespace smopt::metrics {

/// What the plain kernel G0 = 1/(4πr) and the screened one Gκ = exp(-κr)/(4πr) are at a distance r, with A = -G'/r and B = -A'/r for either.
struct RadialKernels {
  double a_plain;       ///< A of G0: 1/(4πr³)
  double g_difference;  ///< G0 - Gκ
  double a_difference;  ///< A0 - Aκ
  double b_difference;  ///< B0 - Bκ
};

/// 1 - (1 + t)·exp(-t) and 3 - (3 + 3t + t²)·exp(-t) for t >= 0: both are t²/2 for small t.
struct ScreeningDefects {
  double first;
  double second;
};

inline ScreeningDefects screening_defects(double t) {
  // Below this the formulas lose digits, t²/2 of 1, and the series Σ (-t)^k (k - 1)/k! and -Σ (-t)^k (k - 1)(k - 3)/k! from k = 2 have relative errors
  // below 1e-13 after twelve terms.
  constexpr double kSeries = 0.3;
  if (t >= kSeries) {
    const double e = std::exp(-t);
    return {1 - (1 + t) * e, 3 - (3 + t * (3 + t)) * e};
  }
  constexpr std::array<double, 12> kFirst = {1.0 / 2,    -1.0 / 3,     1.0 / 8,      -1.0 / 30,      1.0 / 144,      -1.0 / 840,
                                             1.0 / 5760, -1.0 / 45360, 1.0 / 403200, -1.0 / 3991680, 1.0 / 43545600, -1.0 / 518918400};
  double first = 0, second = 0;
  for (int k = 13; k >= 2; --k) {
    const double coefficient = kFirst[static_cast<std::size_t>(k - 2)];
    first = first * t + coefficient;
    second = second * t - (k - 3) * coefficient;
  }
  return {first * t * t, second * t * t};
}

inline RadialKernels radial_kernels(double r, double kappa) {
  const double t = kappa * r;
  const ScreeningDefects defects = screening_defects(t);
  const double g = std::numbers::inv_pi / 4 / r;
  const double a = g / (r * r);
  return {a, -g * std::expm1(-t), a * defects.first, a / (r * r) * defects.second};
}

/// The four kernels of the equations, for outward normals ν at the source y and n at the target x:
/// K1 = G0 - Gκ;  K2 = ε ∂Gκ/∂ν - ∂G0/∂ν;  K3 = ∂G0/∂n - (1/ε) ∂Gκ/∂n;  K4 = ∂²Gκ/∂n∂ν - ∂²G0/∂n∂ν.
struct KernelValues {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;
  double double_layer = 0;  ///< ∂G0/∂ν, which is in K2 too: its integral over a closed surface is known

  void add(const KernelValues& other, double factor = 1) {
    k1 += factor * other.k1;
    k2 += factor * other.k2;
    k3 += factor * other.k3;
    k4 += factor * other.k4;
    double_layer += factor * other.double_layer;
  }
};

struct KernelParameters {
  double kappa;  ///< 1/Å
  double ratio;  ///< ε = ε_out/ε_in
};

/// \param rho   x - y, Å; not 0.
/// \param lift  by how much y stands for a point farther along ν, Å: K3 has 1/r² times the target's small angle to it, and feels it first.
inline KernelValues kernel_values(const Vec3& rho, const Vec3& n, const Vec3& nu, const KernelParameters& parameters, double lift = 0) {
  const RadialKernels radial = radial_kernels(rho.norm(), parameters.kappa);
  const double n_rho = n.dot(rho), nu_rho = nu.dot(rho);
  const double epsilon = parameters.ratio;
  KernelValues k;
  k.double_layer = radial.a_plain * nu_rho;
  k.k1 = radial.g_difference;
  k.k2 = (epsilon - 1) * k.double_layer - epsilon * radial.a_difference * nu_rho;
  k.k3 = -((1 - 1 / epsilon) * radial.a_plain + radial.a_difference / epsilon) * (n_rho - lift * n.dot(nu));
  k.k4 = -radial.a_difference * n.dot(nu) + radial.b_difference * n_rho * nu_rho;
  return k;
}

}  // namespace smopt::metrics
