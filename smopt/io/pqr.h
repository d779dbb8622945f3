#pragma once

#include <string>
#include <string_view>

#include "smopt/io/molecule.h"

namespace smopt {

/// Reads the atoms of a PQR file (APBS, "PQR molecular structure format"): lines ATOM and HETATM whose last five fields are x, y, z (Å),
/// charge (e) and radius (Å); every other line is passed over.
///
/// Three ways are tried on a line, in this order: fields between blanks; the fixed columns of PDB for the coordinates, where columns run
/// together; numbers cut before an inner minus sign (`-12.088-13.641`). A line with fewer fields than the format has is not read by the
/// first way, so that a missing radius is not taken for the charge. \param name  how messages call it. \throws InvalidInput "name:line:
/// what is wrong": a field that is no finite number, a negative radius; also for a file without atoms. Cost: O(bytes).
Molecule parse_pqr(std::string_view text, const std::string& name);

}  // namespace smopt
