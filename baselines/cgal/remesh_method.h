#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// `cgal_remesh` of the registry: CGAL's isotropic remeshing with an edge length, or to a number of vertices (`vertex_target`).
Method remesh_method();

}  // namespace smopt::baselines
