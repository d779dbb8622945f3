#pragma once

#include <optional>
#include <vector>

#include "experiments/solvation_study/solve.h"

namespace smopt::experiments {

/// An ion in the middle of a sphere whose energy is known.
struct BornIon {
  double charge = 1;  ///< e
  double radius = 5;  ///< Å: an eighth of it is the edge of the coarsest mesh
  metrics::DielectricModel medium;

  /// Born 1920, with the electrolyte's factor of Debye and Hückel: q²/(2a) · (1/(ε_out (1 + κa)) − 1/ε_in), kcal/mol.
  [[nodiscard]] double energy() const;
};

struct BornRow {
  double edge = 0;  ///< the mean edge, Å
  Solve solve;
  std::optional<double> error;  ///< of the polar energy, relative, without its sign
  std::optional<double> order;  ///< of the error in the edge, from the row before, where that is above kErrorOfSums
};

struct BornSeries {
  BornIon ion;
  std::vector<BornRow> rows;  ///< from coarse to fine
};

/// Relative errors of the energy below this are those of the solver's sums, not of the mesh: they show no order.
inline constexpr double kErrorOfSums = 5e-5;

/// The ion on icospheres of each number of divisions (3 to 6: 642, 2562, 10 242 and 40 962 vertices).
BornSeries study_born(const BornIon& ion, const std::vector<int>& divisions, const StudyLog& log);

}  // namespace smopt::experiments
