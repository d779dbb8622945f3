#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "smopt/geometry/vec3.h"
#include "smopt/io/radius_set.h"

namespace smopt {

/// Atoms as spheres with point charges; the three arrays have one entry an atom.
struct Molecule {
  std::vector<Vec3> centers;    ///< ångström
  std::vector<double> charges;  ///< elementary charges
  std::vector<double> radii;    ///< ångström, not negative

  [[nodiscard]] std::size_t atom_count() const { return centers.size(); }
};

/// What PDB and mmCIF leave open; PQR and XYZR say everything themselves.
struct MoleculeReadOptions {
  RadiusSet radius_set = RadiusSet::bondi;  ///< radii by element; the default is what needs no explanation in a paper
  /// Whether crystal water is part of the molecule. It is not part of what a surface is wanted of: PDB2PQR's and MSMS's users leave it out.
  bool keep_waters = false;
};

/// What was assumed and what was left out, a sentence each; empty when the file says everything.
struct MoleculeReadReport {
  std::vector<std::string> notes;
};

/// Reads a molecule; the format follows from the name: `.pqr`, `.pdb` or `.ent`, `.cif` or `.mmcif`, `.xyzr`, each with or without `.gz`;
/// `-` is PQR from standard input.
/// \param report  filled when given.
/// \throws InvalidInput naming the file and the line. Cost: O(bytes); 0.1 s for the PQR of a ribosome's 240 000 atoms.
Molecule read_molecule(const std::filesystem::path& path, const MoleculeReadOptions& options = {}, MoleculeReadReport* report = nullptr);

/// Whether `read_molecule` knows the format, by the name's ending.
bool is_readable_molecule_format(const std::filesystem::path& path);

/// The formats by their endings, as help and messages list them: "pqr, pdb, …".
std::string molecule_format_names();

}  // namespace smopt
