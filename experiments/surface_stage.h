#pragma once

#include <string>
#include <vector>

#include "experiments/datasets.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/gaussian_surface.h"
#include "smopt/timing.h"

namespace smopt::experiments {

/// A molecule's surface as it is generated.
struct GeneratedSurface {
  Molecule molecule;            ///< as meshed: small radii are raised
  std::string molecule_sha256;  ///< of its file
  GaussianSurfaceReport report;
  TriangleMesh mesh;
  std::vector<StageTimes> repeats;  ///< "read" and "generate" of each
  double peak_memory_mb = 0;        ///< of the process, meanwhile
};

/// Reads the molecule and meshes its surface on one thread, `repeats` times; the result is the same each time.
/// \throws InvalidInput when the molecule's file is missing (naming the package that brings it) or cannot be used; Cancelled.
GeneratedSurface generate_surface(const Dataset& dataset, int repeats, const ProgressCallback& progress);

}  // namespace smopt::experiments
