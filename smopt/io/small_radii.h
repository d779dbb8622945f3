#pragma once

#include <cstddef>

#include "smopt/io/molecule.h"

namespace smopt {

/// Gives every atom whose radius is below `threshold` the radius `raised`; returns how many.
///
/// AMBER gives hydroxyl hydrogens the radius 0, and a Gaussian of radius 0 still counts as 1 at its centre. TMSmesh takes 0.6 Å for radii
/// below 0.5 Å; the defaults are its own.
/// \param threshold  ångström, not negative. \param raised  ångström, not below `threshold`.
/// \throws InvalidOption when they are not as said. Cost: O(atoms).
std::size_t raise_small_radii(Molecule& molecule, double threshold = 0.5, double raised = 0.6);

}  // namespace smopt
