#include "smopt/surface/trilinear_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "smopt/surface/cell_loops.h"

namespace smopt {
namespace {

void check_grid(const ScalarGrid& grid) {
  if (grid.values.size() != grid.node_count()) throw InvalidInput("a grid's number of values is not that of its nodes");
  for (int axis = 0; axis < 3; ++axis)
    require_resolution(grid.spacing, std::max(std::abs(grid.origin[axis]), std::abs(grid.coordinate(axis, grid.size[axis]))));
}

/// All values are finite, and the outermost nodes outside.
void check_values(const ScalarGrid& grid, double isovalue) {
  const auto [nx, ny, nz] = grid.size;
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t i = 0; i < nx; ++i) {
        const double value = grid.values[grid.index(i, j, k)];
        if (!std::isfinite(value)) throw InvalidInput(fmt::format("the value at grid node ({}, {}, {}) is not finite", i, j, k));
        const bool outermost = i == 0 || j == 0 || k == 0 || i + 1 == nx || j + 1 == ny || k + 1 == nz;
        if (outermost && is_inside(value - isovalue))
          throw InvalidInput(fmt::format("the surface leaves the grid at its outermost node ({}, {}, {})", i, j, k));
      }
    }
  }
}

}  // namespace

TriangleMesh trilinear_surface(const ScalarGrid& grid, double isovalue, TrilinearSurfaceReport* report, const ProgressCallback& progress) {
  check_grid(grid);
  check_values(grid, isovalue);
  BlockMesh block;  // whose shared vertices are none: no edge between outermost nodes is crossed
  const TrilinearSurfaceReport met = mesh_trilinear_block(grid, isovalue, block, progress);
  if (report) *report = met;
  return {std::move(block.points), std::move(block.triangles)};
}

}  // namespace smopt
