#pragma once

#include <string>
#include <string_view>

#include "smopt/io/molecule.h"

namespace smopt {

/// Reads the atoms of an mmCIF file (PDBx/mmCIF dictionary, category `atom_site`): those of the first model in the first data block, with
/// the columns in any order, in a loop or, for a single atom, as items. Radii, water and alternate locations are `molecule_of`'s
/// (atom_site.h).
///
/// Read are Cartn_x, Cartn_y, Cartn_z and type_symbol, which must be there, and, where they are, occupancy, label_alt_id,
/// pdbx_PDB_model_num, pdbx_PDB_ins_code and atom_id, comp_id, asym_id and seq_id (the authors' before the archive's).
/// \param name  how messages call it. \throws InvalidInput "name:line: what is wrong": what is no CIF, a column that is missing or twice
/// there, a row that ends early, coordinates or occupancy that are no finite numbers, an element without a radius; also for a file without
/// atoms. Cost: O(bytes).
Molecule parse_mmcif(std::string_view text, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report);

}  // namespace smopt
