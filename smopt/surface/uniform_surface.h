#pragma once

#include <cstddef>
#include <cstdint>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/surface_estimate.h"
#include "smopt/surface/trilinear_surface.h"

namespace smopt {

/// What the uniform sampler met on its way.
struct UniformSurfaceReport {
  std::size_t grid_nodes = 0;  ///< at which the field was sampled
  TrilinearSurfaceReport cells;
};

/// Meshes the level set φ = c on a uniform grid: `trilinear_surface` by blocks of space, only where the field may reach the isovalue. Nothing is
/// kept of a block but its part of the surface; where the blocks end makes no difference.
/// \param max_memory_bytes  0: what the machine has. It is estimated before the field is sampled, to a few parts in ten.
/// \return a mesh without vertices where the surface does not come between the nodes.
/// \throws InvalidInput for more memory than the limit, or more vertices than 32-bit indices can number; InvalidOption for the spacing.
/// Cost: O(atoms × kernel support + nodes near the surface); about 100 bytes a vertex. All cores, same result for any number of them.
TriangleMesh uniform_surface(const GaussianField& field, const UniformSurface& surface, std::uint64_t max_memory_bytes = 0,
                             UniformSurfaceReport* report = nullptr, const ProgressCallback& progress = {});

}  // namespace smopt
