#pragma once

#include "experiments/datasets.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// A molecule's surface as it is generated.
struct GeneratedSurface {
  Molecule molecule;  ///< as meshed: small radii are raised
  TriangleMesh mesh;
};

/// Reads the molecule and meshes its surface, as `smopt generate` does.
/// \throws InvalidInput when the molecule's file is missing (naming the package that brings it) or cannot be used; Cancelled.
GeneratedSurface generate_surface(const Dataset& dataset, const ProgressCallback& progress);

}  // namespace smopt::experiments
