#pragma once

#include "smopt/improve/remesh/operation.h"

namespace smopt {

/// A vertex goes to the other end of the edge, which stays where it is: triangles from there fill the vertex's ring. Not where that would
/// change the topology (the link condition: Dey, Edelsbrunner, Guha, Nekhayev, Topology preserving edge contraction, 1999) or leave a vertex with
/// fewer than three neighbours.
extern const Operation kEdgeCollapse;

}  // namespace smopt
