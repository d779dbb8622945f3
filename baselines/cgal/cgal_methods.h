#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// Adds the methods of CGAL to the registry.
void register_cgal_methods(MethodRegistry& registry);

}  // namespace smopt::baselines
