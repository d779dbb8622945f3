#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "smopt/io/molecule.h"
#include "smopt/surface/gaussian_field.h"

/// Small molecules for the tests of the convergence study.
namespace smopt::testing {

inline constexpr double kRadius = 1.7;  // Å
inline constexpr double kDecay = 0.6;   // 1/Å²

inline Molecule molecule_of(const std::vector<Vec3>& centers) {
  return {centers, std::vector<double>(centers.size(), 0.0), std::vector<double>(centers.size(), kRadius)};
}

inline GaussianField field_of(const Molecule& molecule) {
  return GaussianField(molecule, {kDecay, 1e-6});
}

/// Where two atoms' surfaces touch: half-way φ is 2·exp(-d·(D²/4 - r²)), which is 1 at this D.
inline double merging_distance() {
  return 2 * std::sqrt(kRadius * kRadius + std::log(2.0) / kDecay);
}

/// The first at the origin, the second in the direction (1, 2, 3).
inline Molecule two_atoms(double distance) {
  return molecule_of({Vec3::Zero(), distance * Vec3(1, 2, 3).normalized()});
}

/// Atoms in a ball at about a protein's density.
inline Molecule random_cluster(std::size_t atoms, std::uint32_t seed) {
  std::mt19937 random(seed);
  const double half_edge = 0.5 * std::cbrt(static_cast<double>(atoms) / 0.06);
  std::uniform_real_distribution<double> coordinate(-half_edge, half_edge);
  std::vector<Vec3> centers;
  for (std::size_t i = 0; i < atoms; ++i) {
    const double x = coordinate(random);
    const double y = coordinate(random);
    centers.emplace_back(x, y, coordinate(random));
  }
  return molecule_of(centers);
}

}  // namespace smopt::testing
