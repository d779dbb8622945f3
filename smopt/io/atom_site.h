#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/io/molecule.h"

namespace smopt {

/// An atom as PDB and mmCIF list it, without a radius; the texts are views of the file's, empty where the file says nothing.
struct AtomSite {
  Vec3 center;           ///< ångström
  double occupancy = 1;  ///< share of the copies of the molecule that have the atom here
  std::size_t line = 0;  ///< where it stands
  std::string_view element;
  std::string_view atom;  ///< its name within the residue
  std::string_view residue;
  std::string_view alternate;  ///< which of several locations
  std::string_view chain;
  std::string_view residue_number;
  std::string_view insertion;  ///< tells residues of the same number apart
};

/// The molecule of these atoms: water and all but one of alternate locations left out, radii by element, charges 0. What was assumed and
/// left out is added to the notes.
/// \param name  how messages call the file. \throws InvalidInput "name:line: …" for an element the radius set has no radius for; also when
/// nothing but water is there. Cost: O(atoms).
Molecule molecule_of(std::vector<AtomSite> sites, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report);

}  // namespace smopt
