#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The entry `external:mmgs`: MMG's remeshing of surfaces (`mmgs_O3` or `mmgs`), looked for when it is run, not before. Vertices and
/// triangles are new ones.
Method external_mmgs_method();

}  // namespace smopt::baselines
