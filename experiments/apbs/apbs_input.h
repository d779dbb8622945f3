#pragma once

#include <array>
#include <string>
#include <string_view>

#include "metrics/solvation/dielectric_model.h"
#include "smopt/geometry/vec3.h"
#include "smopt/io/molecule.h"

namespace smopt::experiments {

/// What APBS takes for the boundary of the solute.
enum class ApbsSurface {
  molecular,           ///< where a probe sphere of 1.4 Å rolls over the atoms
  smoothed_molecular,  ///< the same, the permittivity smoothed by a harmonic average over neighbouring nodes
  van_der_waals,       ///< the atoms' spheres
  gaussian             ///< this project's own, φ = c, by maps of the permittivity: what is left is the difference of the methods
};

/// "molecular", "molecular, smoothed", "van der Waals", "Gaussian".
std::string_view to_string(ApbsSurface surface);

/// The grid around the atoms' bounding box.
struct ApbsGrid {
  std::array<int, 3> nodes{};  ///< along each axis: 32·c + 1, which its multigrid can halve five times
  double spacing = 0;          ///< Å
  Vec3 center = Vec3::Zero();
  Vec3 coarse_length = Vec3::Zero();  ///< of the coarser grid whose solution gives this one its boundary values (`mg-auto`), Å

  [[nodiscard]] Vec3 length() const { return spacing * Vec3(nodes[0] - 1, nodes[1] - 1, nodes[2] - 1); }
  [[nodiscard]] Vec3 low() const { return center - length() / 2; }
  [[nodiscard]] double node_count() const { return static_cast<double>(nodes[0]) * nodes[1] * nodes[2]; }
  /// What APBS needs for it, in MB: 230 bytes a node and 120 MB, the largest of eight runs of 65³ to 225³ nodes but for 129³, which takes 230 MB
  /// more; and maps, where the surface needs them.
  [[nodiscard]] double memory_mb(ApbsSurface surface) const;
};

/// The grid of a spacing around a molecule. \pre at least one atom. \throws InvalidOption unless spacing is positive, and for more nodes than any
/// machine holds.
ApbsGrid apbs_grid(const Molecule& molecule, double spacing);

/// The maps that a Gaussian surface needs: the permittivity half a step along x, y and z from each node, and where the ions are.
inline constexpr std::array<std::string_view, 4> kApbsMaps = {"permittivity_x.dx", "permittivity_y.dx", "permittivity_z.dx", "ions.dx"};

/// The input file for the polar solvation energy of a molecule read from `pqr`: the solvated solute minus the same in a medium of its own
/// permittivity without ions, on the same grid, so that the grid's self-energies cancel. Charges are spread by cubic B-splines; the ions have no
/// radius, since a boundary-element solver has no layer without ions. A Gaussian surface's maps are read from `kApbsMaps`.
std::string apbs_input(std::string_view pqr, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid);

/// The molecule as PQR, one atom a line, to 1e-6.
std::string format_pqr(const Molecule& molecule);

/// The difference of energies that APBS prints, in kcal/mol. \throws MethodFailed when there is none in the text.
double parse_apbs_energy(std::string_view output);

}  // namespace smopt::experiments
