#include "tests/metrics/solvation/direct_energy.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "smopt/error.h"

namespace smopt::testing {
namespace {

using Real = long double;
using RealVec3 = Eigen::Matrix<Real, 3, 1>;

constexpr Real kFourPi = 4 * std::numbers::pi_v<Real>;

struct QuadraturePoint {
  RealVec3 corners;  ///< barycentric coordinates
  Real weight;       ///< share of the triangle's area
};

/// Radon's rule: the centroid and two orbits of three, (b, b, 1 − 2b) with b = (6 ∓ √15)/21.
std::vector<QuadraturePoint> seven_points() {
  std::vector<QuadraturePoint> points = {{RealVec3::Constant(1.0L / 3), 9.0L / 40}};
  for (const Real root : {-std::sqrt(15.0L), std::sqrt(15.0L)}) {
    for (int corner = 0; corner < 3; ++corner) {
      RealVec3 at = RealVec3::Constant((6 + root) / 21);
      at[corner] = 1 - 2 * (6 + root) / 21;
      points.push_back({at, (155 + root) / 1200});
    }
  }
  return points;
}

/// The rule on each of the four triangles that the edges' midpoints make.
std::vector<QuadraturePoint> divided_once(const std::vector<QuadraturePoint>& rule) {
  const RealVec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
  const RealVec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  const std::array<std::array<RealVec3, 3>, 4> parts = {{{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}};
  std::vector<QuadraturePoint> points;
  for (const auto& [p, q, r] : parts)
    for (const auto& [at, weight] : rule) points.push_back({at[0] * p + at[1] * q + at[2] * r, weight / 4});
  return points;
}

/// q ∫ [K1 ∂φ/∂ν + K2 φ] of one point charge over an element of the surface.
class EnergyKernel {
 public:
  explicit EnergyKernel(const DielectricSphere& medium) : ratio_(static_cast<Real>(medium.outer) / medium.inner), kappa_(medium.kappa) {}

  /// `area` is the element's normal times its area.
  [[nodiscard]] Real operator()(const RealVec3& from_charge, const RealVec3& area, Real potential, Real derivative) const {
    const Real r = from_charge.norm();
    const Real screening = std::exp(-kappa_ * r);
    const Real k1 = -std::expm1(-kappa_ * r) / (kFourPi * r);
    const Real flux = -from_charge.dot(area) / (kFourPi * r * r * r);  // ∂G0/∂ν dS
    const Real k2 = ratio_ * (1 + kappa_ * r) * screening * flux - flux;
    return k1 * derivative * area.norm() + k2 * potential;
  }

 private:
  Real ratio_;
  Real kappa_;
};

}  // namespace

double direct_polar_energy(const TriangleMesh& mesh, const DielectricSphere& medium, std::span<const PointCharge> charges,
                           std::span<const SurfacePotential> unknowns) {
  if (unknowns.size() != mesh.points.size())
    throw InvalidInput(fmt::format("{} unknowns for {} vertices", unknowns.size(), mesh.points.size()));
  const std::vector<QuadraturePoint> rule = divided_once(seven_points());
  const EnergyKernel kernel(medium);
  Real sum = 0;
  for (const Triangle& t : mesh.triangles) {
    Eigen::Matrix<Real, 3, 3> corners;
    RealVec3 potential, derivative;
    for (int i = 0; i < 3; ++i) {
      corners.col(i) = mesh.points[t[i]].cast<Real>();
      potential[i] = unknowns[t[i]].potential;
      derivative[i] = unknowns[t[i]].normal_derivative;
    }
    const RealVec3 area = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)) / 2;
    for (const auto& [at, weight] : rule) {
      const RealVec3 y = corners * at;
      for (const auto& [x, charge] : charges)
        sum += charge * kernel(y - x.cast<Real>(), weight * area, potential.dot(at), derivative.dot(at));
    }
  }
  return static_cast<double>(kFourPi * kCoulombConstant / 2 * sum);
}

}  // namespace smopt::testing
