#include "tests/metrics/solvation/kirkwood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "smopt/error.h"

namespace smopt::testing {
namespace {

using Real = long double;

constexpr Real kFourPi = 4 * std::numbers::pi_v<Real>;

/// What a series may leave out, relative to its first term's bound: a tenth of long double's rounding, and far below 1e-14 of the sum even
/// where charges of opposite signs cancel to a millionth.
constexpr Real kSeriesTail = 1e-20L;

/// A mesh's vertices are this close to their sphere when read from a file with six digits, relative to the radius.
constexpr double kOnSphereRel = 1e-5;

/// A charge is at least this far below the surface, relative to the radius: above kOnSphereRel, so that every series converges; two million
/// terms at the most.
constexpr double kDepthRel = 5e-5;

void require_medium(double radius, const DielectricSphere& medium) {
  if (radius > 0 && std::isfinite(radius) && medium.inner > 0 && medium.outer > 0 && medium.kappa >= 0) return;
  throw InvalidInput(
      fmt::format("a sphere of radius {} with permittivities {} and {}, kappa {}", radius, medium.inner, medium.outer, medium.kappa));
}

void require_charges_inside(double radius, std::span<const PointCharge> charges) {
  for (std::size_t i = 0; i < charges.size(); ++i) {
    if (charges[i].position.norm() <= radius * (1 - kDepthRel)) continue;
    throw InvalidInput(fmt::format("charge {} is {} from the centre: not, or hardly, inside the sphere of radius {}", i,
                                   charges[i].position.norm(), radius));
  }
}

Real dot(const Vec3& a, const Vec3& b) {
  return static_cast<Real>(a.x()) * b.x() + static_cast<Real>(a.y()) * b.y() + static_cast<Real>(a.z()) * b.z();
}

Real outermost(std::span<const PointCharge> charges) {
  Real squared = 0;
  for (const PointCharge& c : charges) squared = std::max(squared, dot(c.position, c.position));
  return std::sqrt(squared);
}

/// How many terms of size at most (2n+1) t^n matter; those left out come to at most (2n+1) t^n/(1−t)².
int term_count(Real t) {
  int n = 1;
  for (Real power = t; static_cast<Real>(2 * n + 1) * power > kSeriesTail * (1 - t) * (1 - t); power *= t) ++n;
  return n;
}

/// Σ_n factors[n] t^n P_n(cos γ) from t cos γ and t². The powers inside the recurrence spare a division by t, which may be 0.
Real legendre_series(const std::vector<Real>& factors, Real t_cos, Real t_squared) {
  Real sum = 0;
  Real previous = 0;
  Real current = 1;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    sum += factors[i] * current;
    const auto n = static_cast<Real>(i);
    const Real next = ((2 * n + 1) * t_cos * current - n * t_squared * previous) / (n + 1);
    previous = current;
    current = next;
  }
  return sum;
}

/// ε L_n of the derivation.
std::vector<Real> slopes(int count, Real radius, const DielectricSphere& medium) {
  const Real z = medium.kappa * radius;
  const Real ratio = static_cast<Real>(medium.outer) / medium.inner;
  const std::vector<Real> k = scaled_spherical_k(count, z);
  std::vector<Real> result = {ratio * (1 + z)};
  for (int n = 1; n < count; ++n) result.push_back(ratio * (n + 1 + z * z / (2 * n - 1) * k[n - 1] / k[n]));
  return result;
}

/// u_n a^(n+1)/(c s^n) of the derivation.
std::vector<Real> surface_factors(const std::vector<Real>& slope) {
  std::vector<Real> result(slope.size());
  for (std::size_t n = 0; n < slope.size(); ++n) result[n] = static_cast<Real>(2 * n + 1) / (static_cast<Real>(n) + slope[n]);
  return result;
}

/// A_n a^(2n+1)/(c s^n) of the derivation.
std::vector<Real> reaction_factors(const std::vector<Real>& slope) {
  std::vector<Real> result(slope.size());
  for (std::size_t n = 0; n < slope.size(); ++n) result[n] = (static_cast<Real>(n + 1) - slope[n]) / (static_cast<Real>(n) + slope[n]);
  return result;
}

/// Σ_j q_j/(4π ε_in length) Σ_n factors[n] t^n P_n with t cos γ = x_j · y and t² = |x_j|² |y|².
Real sum_over_charges(const std::vector<Real>& factors, Real length, const DielectricSphere& medium, std::span<const PointCharge> charges,
                      const Vec3& point, Real point_scale) {
  const Real point_squared = dot(point, point) * point_scale * point_scale;
  Real sum = 0;
  for (const auto& [position, charge] : charges)
    sum += charge * legendre_series(factors, dot(position, point) * point_scale, dot(position, position) * point_squared);
  return sum / (kFourPi * medium.inner * length);
}

Real reaction_potential(Real radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point) {
  const Real t = outermost(charges) * std::sqrt(dot(point, point)) / (radius * radius);
  const std::vector<Real> factors = reaction_factors(slopes(term_count(t), radius, medium));
  return sum_over_charges(factors, radius, medium, charges, point, 1 / (radius * radius));
}

}  // namespace

double born_energy(double charge, double radius, const DielectricSphere& medium) {
  require_medium(radius, medium);
  const double transfer = 1 / (medium.outer * (1 + medium.kappa * radius)) - 1 / medium.inner;
  return kCoulombConstant * charge * charge / (2 * radius) * transfer;
}

double kirkwood_energy(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges) {
  require_medium(radius, medium);
  require_charges_inside(radius, charges);
  Real sum = 0;
  for (const auto& [position, charge] : charges) sum += charge * reaction_potential(radius, medium, charges, position);
  return static_cast<double>(kFourPi * kCoulombConstant / 2 * sum);
}

SurfacePotential kirkwood_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges,
                                    const Vec3& point) {
  require_medium(radius, medium);
  require_charges_inside(radius, charges);
  const Real distance = std::sqrt(dot(point, point));
  if (!(std::abs(distance - radius) <= kOnSphereRel * radius))
    throw InvalidInput(fmt::format("a point {} from the centre is not on the sphere of radius {}", static_cast<double>(distance), radius));

  const std::vector<Real> slope = slopes(term_count(outermost(charges) / radius), radius, medium);
  const std::vector<Real> factors = surface_factors(slope);
  std::vector<Real> derivative_factors(slope.size());
  std::transform(slope.begin(), slope.end(), factors.begin(), derivative_factors.begin(), [](Real l, Real u) { return -l * u; });

  const Real to_unit_over_radius = 1 / (distance * radius);
  const auto sum = [&](const std::vector<Real>& f) { return sum_over_charges(f, radius, medium, charges, point, to_unit_over_radius); };
  return {static_cast<double>(sum(factors)), static_cast<double>(sum(derivative_factors) / radius)};
}

double kirkwood_reaction_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point) {
  require_medium(radius, medium);
  require_charges_inside(radius, charges);
  if (!(point.norm() <= radius * (1 + kOnSphereRel)))
    throw InvalidInput(fmt::format("a point {} from the centre is outside the sphere of radius {}", point.norm(), radius));
  return static_cast<double>(reaction_potential(radius, medium, charges, point));
}

double kirkwood_exterior_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point) {
  require_medium(radius, medium);
  require_charges_inside(radius, charges);
  const Real distance = std::sqrt(dot(point, point));
  if (!(distance >= radius * (1 - kOnSphereRel)))
    throw InvalidInput(fmt::format("a point {} from the centre is inside the sphere of radius {}", static_cast<double>(distance), radius));

  // k_n(κr)/k_n(κa) = (a/r)^(n+1) e^(−κ(r−a)) times the ratio of the scaled functions; the powers of a/r turn (s/a)^n into (s/r)^n.
  const int count = term_count(outermost(charges) / std::min<Real>(distance, radius));
  std::vector<Real> factors = surface_factors(slopes(count, radius, medium));
  const std::vector<Real> far = scaled_spherical_k(count, medium.kappa * distance);
  const std::vector<Real> near = scaled_spherical_k(count, static_cast<Real>(medium.kappa) * radius);
  const Real decay = std::exp(-medium.kappa * (distance - radius));
  for (int n = 0; n < count; ++n) factors[n] *= decay * far[n] / near[n];
  return static_cast<double>(sum_over_charges(factors, distance, medium, charges, point, 1 / (distance * distance)));
}

std::vector<long double> scaled_spherical_k(int count, long double z) {
  std::vector<Real> k = {1, 1 + z};
  for (int n = 1; n + 1 < count; ++n) k.push_back(k[n] + z * z / (static_cast<Real>(2 * n + 1) * (2 * n - 1)) * k[n - 1]);
  k.resize(static_cast<std::size_t>(count));
  return k;
}

}  // namespace smopt::testing
