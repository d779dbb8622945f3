#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// Adds the external tools. None is looked for here: one that is absent says so when it is run.
void register_external_tools(MethodRegistry& registry);

}  // namespace smopt::baselines
