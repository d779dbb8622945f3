#pragma once

#include <cstddef>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/scalar_grid.h"
#include "smopt/surface/trilinear_block.h"

namespace smopt {

/// Meshes the level set of a grid of values, trilinear in each cell.
///
/// A node is inside where its value is not below the isovalue. The mesh has one vertex on each grid edge between an inside and an
/// outside node, at the zero of the linear interpolant; it is closed, edge- and vertex-manifold, oriented outwards (towards smaller
/// values), free of intersections, and its topology in every cell is that of the trilinear interpolant (a value that is exactly
/// critical counts as slightly larger). A few cells with ambiguous faces get vertices inside (see `triangulate_cell`).
/// \throws InvalidInput when a value is not finite, an outermost node is inside, or the spacing is too small for coordinates so far
/// from the origin.
/// Cost: O(nodes); memory for two layers of the grid besides the mesh. Deterministic, one thread.
TriangleMesh trilinear_surface(const ScalarGrid& grid, double isovalue, TrilinearSurfaceReport* report = nullptr,
                               const ProgressCallback& progress = {});

}  // namespace smopt
