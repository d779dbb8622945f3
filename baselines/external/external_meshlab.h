#pragma once

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The entry `external:meshlab`: MeshLab's own "Laplacian Smooth", run by `meshlabserver` in a virtual screen (`xvfb-run`). It is looked for
/// when it is run, not before. The mesh goes in as PLY of doubles and comes out as PLY of floats, MeshLab's own precision, in the same order
/// of vertices and triangles.
Method external_meshlab_method();

}  // namespace smopt::baselines
