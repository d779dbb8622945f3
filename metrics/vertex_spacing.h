#pragma once

#include <optional>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// The smallest distance between any two vertices, neighbours or not, as a share of the diagonal of their box: in [0, 1], 0 where two are at one
/// place. Vertices in no triangle count.
/// \return nothing for fewer than two vertices or one that is not finite. Cost: O(n log n).
std::optional<double> smallest_vertex_spacing(const TriangleMesh& mesh);

}  // namespace smopt::metrics
