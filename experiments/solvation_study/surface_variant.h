#pragma once

#include <string_view>

#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {

/// The meshes of one surface that the study solves on.
enum class SurfaceVariant {
  generated,          ///< as the generator makes it, with cavities
  initial,            ///< without them, which all that follow are too
  projected,          ///< the initial mesh, its vertices brought onto φ = c
  smopt,              ///< improved with the defaults: it shrinks
  volume_preserving,  ///< improved with `--step volume-preserving`
  improved_projected  ///< improved with the defaults, then brought onto φ = c
};

/// "as generated", "initial", "initial, projected", "smopt", "smopt, volume-preserving", "smopt, projected".
std::string_view to_string(SurfaceVariant variant);

/// \param generated  the surface of `molecule` with these options. \throws what the stages throw.
TriangleMesh variant_of(const TriangleMesh& generated, SurfaceVariant variant, const Molecule& molecule,
                        const GaussianSurfaceOptions& options);

}  // namespace smopt::experiments
