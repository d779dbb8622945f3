#pragma once

#include <string>

#include "metrics/tetgen/tet_mesh.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Whether `result` is a tetrahedral mesh of what `surface` encloses; TetGen's word is not taken for it.
///
/// Checked: there are tetrahedra; the points of the surface are there, unmoved, each a corner of a tetrahedron; every boundary face is a
/// face of a tetrahedron; with `boundary_kept` every triangle of the surface is a face of a tetrahedron, without it the boundary faces of
/// each triangle lie in it and their areas sum to its area; the volumes sum to the enclosed volume to 1e-9 relative. Inner cavities count
/// as filled, as TetGen without hole points does it: the enclosed volume is that of the shells with tetrahedra on one side. \param surface
/// finite coordinates, and every point in a triangle. \param boundary_kept  TetGen was told not to split triangles (`Y`). \return empty
/// when it is, otherwise the first thing that is wrong, in words. Cost: O(n log n).
std::string why_not_a_mesh_of(const TriangleMesh& surface, const TetMesh& result, bool boundary_kept);

}  // namespace smopt::metrics
