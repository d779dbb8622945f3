#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The registry's entry of ISO2mesh: `meshresample` to a number of vertices (`resample`), where one is asked for, then `smoothsurf`.
Method iso2mesh_method();

}  // namespace smopt::baselines
