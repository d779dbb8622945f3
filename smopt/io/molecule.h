#pragma once

#include <filesystem>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Atoms as spheres with point charges; the three arrays have one entry an atom.
struct Molecule {
  std::vector<Vec3> centers;    ///< ångström
  std::vector<double> charges;  ///< elementary charges
  std::vector<double> radii;    ///< ångström, not negative

  [[nodiscard]] std::size_t atom_count() const { return centers.size(); }
};

/// Reads a molecule; the format follows from the name (`.pqr`, with or without `.gz`; `-` is PQR from standard input).
/// \throws InvalidInput naming the file and the line.
Molecule read_molecule(const std::filesystem::path& path);

}  // namespace smopt
