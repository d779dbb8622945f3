#pragma once

#include "baselines/cgal/angle_area_smoothing.h"
#include "smopt/improve/method.h"

namespace smopt::baselines {

/// `cgal_area` of the registry: CGAL's smoothing of areas and angles, its default. Where it is not built in (`is_built`), the entry says so,
/// and running it throws NotInstalled.
Method area_method(bool is_built = has_area_smoothing());

}  // namespace smopt::baselines
