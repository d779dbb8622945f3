#pragma once

#include "smopt/progress.h"
#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// A Gaussian surface that is meshed on a uniform grid: the field's level, and the edge of the grid's cubes in ångström.
struct UniformSurface {
  double isovalue = 1;
  double spacing = 1;
};

/// More vertices than the mesh will have, from the atoms alone: where n kernels sum up to c, one of them is at least c/n, so that the surface
/// lies within a ball around each atom; all the balls' surfaces together, and a tenth more, are taken for its area. Some hundred times too many for a protein.
/// A plane of random direction crosses 1.5/h² edges of a grid on each unit of its area.
/// Cost: O(n).
double most_vertices(const GaussianField& field, const UniformSurface& surface);

/// The vertices that the mesh will have: those on a grid of 1.5 Å (or of the spacing, when that is larger) counted without making the mesh, times
/// the ratio of the spacings squared. Molecules show some per cent more on finer grids.
/// Cost: O(n) field sampling on the coarse grid; all cores. Memory for a block a thread.
double estimated_vertices(const GaussianField& field, const UniformSurface& surface, const ProgressCallback& progress = {});

/// Memory that making a mesh of so many vertices takes at its largest, in bytes.
double bytes_to_mesh(const GaussianField& field, double vertices);

}  // namespace smopt
