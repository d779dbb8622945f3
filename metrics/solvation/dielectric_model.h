#pragma once

#include <cmath>
#include <numbers>

namespace smopt::metrics {

/// e²/(4π ε_0), kcal·Å/mol: the energy of two elementary charges one ångström apart in vacuum, as AFMPB has it.
inline constexpr double kCoulombConstant = 332.06;

/// The gas constant, kcal/(mol·K).
inline constexpr double kGasConstant = 0.0019872043;

/// A solute of one permittivity in an electrolyte of 1:1 salt, under the linearised Poisson–Boltzmann equation. The defaults are AFMPB's.
struct DielectricModel {
  double inner = 2;             ///< relative permittivity of the solute; positive
  double outer = 80;            ///< relative permittivity of the solvent; positive
  double ionic_strength = 150;  ///< of the solvent, mmol/l; at least 0
  double temperature = 300;     ///< kelvin; positive

  /// ε_out/ε_in.
  [[nodiscard]] double ratio() const { return outer / inner; }
  /// Inverse screening length, 1/Å: AFMPB's formula; 0.125714 for the defaults.
  [[nodiscard]] double kappa() const {
    constexpr double kDebyeFactor = 2.528639884;  // 2·N_A·e²/(ε_0·k_B) in K·l/(mmol·Å²): AFMPB's figure
    return std::sqrt(kDebyeFactor * ionic_strength / outer / temperature);
  }
  /// k_B·T, kcal/mol.
  [[nodiscard]] double thermal_energy() const { return kGasConstant * temperature; }
};

/// With kernels that carry 1/(4π) and charges in e, potentials are in e/Å; this makes kcal/mol/e of them.
inline constexpr double kPotentialUnit = 4 * std::numbers::pi * kCoulombConstant;

}  // namespace smopt::metrics
