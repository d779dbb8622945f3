#pragma once

#include <optional>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// The smallest angle between two triangles that share an edge, degrees in [0, 180]: 0 where one is folded onto the other, 90 at a cube's edge,
/// 180 where both lie in a plane. Bends inwards and outwards count alike.
///
/// Over the edges with exactly two triangles, as all have in a closed manifold. A triangle without an area has an angle of 0 to its neighbours.
/// \return nothing where there is no such edge or a triangle has a corner that is not finite. Cost: O(n log n).
std::optional<double> smallest_dihedral_deg(const TriangleMesh& mesh);

}  // namespace smopt::metrics
