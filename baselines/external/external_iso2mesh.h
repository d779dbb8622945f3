#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The entry `external:iso2mesh`: the user's own copy of ISO2mesh, run by GNU Octave: `meshresample` where fewer vertices are wanted, and
/// `smoothsurf`. Octave and the folder are looked for when it is run, not before. Positions go in and out as text of 17 digits, which is
/// every bit of them.
Method external_iso2mesh_method();

}  // namespace smopt::baselines
