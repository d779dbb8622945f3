#pragma once

#include <array>
#include <string>
#include <string_view>

#include "metrics/solvation/dielectric_model.h"
#include "smopt/geometry/vec3.h"
#include "smopt/io/molecule.h"

namespace smopt::experiments {

/// What APBS takes for the boundary of the solute: a probe sphere of 1.4 Å rolls over the atoms and its inward side is taken (molecular), the
/// same with the permittivity smoothed from one side to the other by a harmonic average over neighbouring nodes (smoothed), or the atoms' spheres
/// themselves (van der Waals). None is a Gaussian surface; the first two are the nearest to one.
enum class ApbsSurface { molecular, smoothed_molecular, van_der_waals };

/// "molecular", "molecular, smoothed", "van der Waals".
std::string_view to_string(ApbsSurface surface);

/// The finer of the two nested grids of APBS's `mg-auto`, around the atoms' bounding box.
struct ApbsGrid {
  std::array<int, 3> nodes{};  ///< along each axis: 32·c + 1, which its multigrid can halve five times
  Vec3 fine_length;            ///< edges of the box, Å
  Vec3 coarse_length;          ///< of the box whose solution gives the finer one its boundary values, Å

  [[nodiscard]] Vec3 spacing() const;
  /// What APBS needs for it, in MB: 230 bytes a node and 120 MB, the largest of eight runs of 65³ to 225³ nodes but for 129³, which takes 230 MB
  /// more.
  [[nodiscard]] double memory_mb() const;
};

/// The grid whose spacing is at most `spacing` along every axis. \pre at least one atom. \throws InvalidOption unless spacing is positive.
ApbsGrid apbs_grid(const Molecule& molecule, double spacing);

/// The input file for the polar solvation energy of a molecule read from `pqr`: the solvated solute minus the same in a medium of its own
/// permittivity without ions, on the same grid, so that the grid's self-energies cancel. Charges are spread by cubic B-splines; the ions have no
/// radius, since a boundary-element solver has no layer without ions.
std::string apbs_input(std::string_view pqr, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid);

/// The molecule as PQR, one atom a line, to 1e-6.
std::string format_pqr(const Molecule& molecule);

/// The difference of energies that APBS prints, in kcal/mol. \throws MethodFailed when there is none in the text.
double parse_apbs_energy(std::string_view output);

}  // namespace smopt::experiments
