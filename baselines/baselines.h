#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// Adds every baseline to the registry.
void register_baselines(MethodRegistry& registry);

/// The registry of all methods: smopt and the baselines.
const MethodRegistry& all_methods();

}  // namespace smopt::baselines
