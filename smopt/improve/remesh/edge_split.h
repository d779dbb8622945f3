#pragma once

#include "smopt/improve/remesh/operation.h"

namespace smopt {

/// A new vertex in the middle of the edge: the two triangles at the edge become four. \pre the state has spare numbers for the vertex visited.
extern const Operation kEdgeSplit;

}  // namespace smopt
