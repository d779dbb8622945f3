#pragma once

#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// Flips edges for better angles, as GAMer 2 does after each step of its smoothing (Lee et al., PLoS Comput. Biol. 16:e1007756, 2020).
///
/// An edge is flipped when its two triangles' doubled areas, summed and squared, do not grow by more than 0.1 %, and either the four valences
/// come much nearer to 6 (the sum of the squares of their excess falls by more than 3), or they do not get much worse (it grows by no more)
/// and the smallest angle grows. Never where the new edge exists already. Edges within three steps over triangles of one that is flipped wait
/// for the next round, so that flips do not meet. Edges are taken in ascending order of their ends (GAMer: in that of its hash table).
/// Nothing keeps triangles from intersecting.
/// \param rings  of `mesh` as it comes; no longer its own afterwards, where anything was flipped. \return how many edges were flipped.
/// Cost: O(n); 0.1 µs an edge.
std::size_t flip_edges(TriangleMesh& mesh, const VertexRings& rings);

}  // namespace smopt::baselines
