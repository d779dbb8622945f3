#pragma once

#include <cstdint>
#include <vector>

#include "smopt/io/molecule.h"

namespace smopt::testing {

/// Atoms with these centres and radii, and without charges.
Molecule molecule_of(std::vector<Vec3> centers, std::vector<double> radii);

/// A cluster of atoms like those of a protein: radii from 0 to 2 Å, each centre 0.5 to 3 Å from an earlier one, so that spheres are nested,
/// overlap, nearly touch and stand apart. The same for the same seed.
Molecule random_cluster(std::size_t atoms, std::uint32_t seed);

}  // namespace smopt::testing
