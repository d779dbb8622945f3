#pragma once

#include "smopt/improve/remesh/operation.h"

namespace smopt {

/// The two triangles at an edge become the two at the other diagonal of their quadrilateral. Not where that is an edge already or a vertex would
/// be left with fewer than three neighbours.
extern const Operation kEdgeFlip;

}  // namespace smopt
