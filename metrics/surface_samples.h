#pragma once

#include <cstddef>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Points spread evenly over a surface, each standing for an equal part of its area, in the order of the triangles: a mean over them is a
/// mean over the surface, however its vertices lie.
///
/// Stratified by area, within the triangles by a low-discrepancy sequence (R₂, Roberts 2018): the same points for the same mesh.
/// \return `count` points, Å; none for a mesh without an area or with a triangle whose corner is not finite. Cost: O(n + count).
std::vector<Vec3> sample_surface(const TriangleMesh& mesh, std::size_t count);

}  // namespace smopt::metrics
