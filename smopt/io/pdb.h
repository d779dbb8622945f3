#pragma once

#include <string>
#include <string_view>

#include "smopt/io/molecule.h"

namespace smopt {

/// Reads the atoms of a PDB file (wwPDB, file format 3.3, section 9): the lines ATOM and HETATM of the first model, in fixed columns; every
/// other line is passed over. Radii, water and alternate locations are `molecule_of`'s (atom_site.h).
///
/// The element stands in columns 77–78. Where they have no letters (older files), the atom's name tells it: columns 13–14 hold the
/// element's symbol aligned to the right, but for hydrogens whose names have four characters; in the standard residues of proteins and
/// nucleic acids, whose names some programs align otherwise, it is the first letter; and an atom that is named as its residue is an ion.
/// \param name  how messages call it. \throws InvalidInput "name:line: what is wrong": a line that ends before column 54, coordinates or
/// occupancy that are no finite numbers or not in their columns, an element without a radius; also for a file without atoms. Cost:
/// O(bytes).
Molecule parse_pdb(std::string_view text, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report);

}  // namespace smopt
