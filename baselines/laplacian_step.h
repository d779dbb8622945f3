#pragma once

#include "baselines/vertex_neighbours.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// One Jacobi step of Laplacian smoothing, on all threads: to[v] = from[v] + weight · (mean of the neighbours in `from` − from[v]).
/// Vertices without neighbours keep their place. \pre a zero stands behind the positions of `from` (`with_zero_behind`), and `to` is another
/// array of that size, whose last element is not touched. Same bytes for any number of threads.
void laplacian_step(const VertexNeighbours& neighbours, double weight, const std::vector<Vec3>& from, std::vector<Vec3>& to);

}  // namespace smopt::baselines
