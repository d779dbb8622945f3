#pragma once

#include <algorithm>
#include <cstddef>

#include "smopt/progress.h"
#include "smopt/surface/block_mesh.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt {

/// A vertex keeps this distance from the ends of its edge, in edges, so that it is strictly inside: a node whose value is the
/// isovalue would else be the place of up to six vertices.
inline constexpr double kLeastParameter = 1e-6;

/// Where the linear interpolant between two values of different sign is zero, in edges from the first.
inline double zero_between(double first, double second) {
  return std::clamp(first / (first - second), kLeastParameter, 1 - kLeastParameter);
}

/// \throws InvalidInput when doubles at a distance from the origin do not resolve the least parameter of edges of this length.
void require_resolution(double spacing, double distance);

/// What the mesher met on its way.
struct TrilinearSurfaceReport {
  std::size_t surface_cells = 0;      ///< cells the surface crosses
  std::size_t ambiguous_cells = 0;    ///< cells with an ambiguous face or more than one loop
  std::size_t tunnel_cells = 0;       ///< cells in which two loops are the ends of one tunnel
  std::size_t interior_vertices = 0;  ///< vertices inside cells, where no other triangulation is free of intersections

  TrilinearSurfaceReport& operator+=(const TrilinearSurfaceReport& other);
};

/// Meshes the level set of one block of an unbounded grid, trilinear in each cell (see `trilinear_surface`). Blocks that have the nodes
/// between them in common fit together: what they have in common are vertices on edges in their outer faces, listed as shared.
/// \pre the values are finite, and `block.first` + `block.size` fit 32 bits.
/// \param mesh  receives the result; its memory is used again.
/// \return what was met in this block.
/// \throws InvalidInput when the vertices are more than 32-bit indices can number.
/// Cost: O(nodes); memory for two layers of the block besides the mesh.
TrilinearSurfaceReport mesh_trilinear_block(const ScalarGrid& block, double isovalue, BlockMesh& mesh,
                                            const ProgressCallback& progress = {});

}  // namespace smopt
