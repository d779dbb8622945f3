#pragma once

#include <string>
#include <string_view>

#include "smopt/io/molecule.h"

namespace smopt {

/// Reads the spheres of an XYZR file, the input of MSMS (Sanner, Olson, Spehner 1996): a line `x y z r` in ångström for each; what follows
/// on a line (MSMS's `.xyzrn` has a flag and a label there) is passed over, as are empty lines and comments from `#`. Charges are 0.
/// \param name  how messages call it. \throws InvalidInput "name:line: what is wrong": a field that is missing or no finite number, a
/// negative radius; also for a file without atoms. Cost: O(bytes).
Molecule parse_xyzr(std::string_view text, const std::string& name);

}  // namespace smopt
