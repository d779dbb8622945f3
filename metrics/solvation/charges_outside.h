#pragma once

#include <cstddef>

#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Counts the charges, other than 0, that a closed surface does not enclose.
///
/// A point is enclosed when a ray from it crosses the surface an odd number of times, decided with CGAL's exact predicates; so a point in a
/// cavity is outside, and the orientation does not matter. A point on the surface is outside. Rays go straight up, and meet edges, vertices
/// and upright triangles as if the point were moved aside by less than any number (Edelsbrunner & Mücke 1990), so that none has to be cast
/// twice. Triangles may intersect, have no area and share points only by their coordinates.
/// \pre every edge has an even number of triangles, triangles and charged atoms have finite coordinates.
/// Cost: O(n log n), on all cores; 0.04 s for 130 000 triangles and 8 300 charges. The result is the same for any number of threads.
std::size_t count_charges_outside(const TriangleMesh& surface, const Molecule& molecule);

}  // namespace smopt::metrics
