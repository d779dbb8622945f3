#pragma once

#include "metrics/solvation/discrete_surface.h"
#include "metrics/solvation/solvate.h"

namespace smopt::metrics {

/// Memory that the solve takes at its largest, bytes: sources and fields of the vertices, the far field, the close pairs (counted at a sample of the
/// vertices), the preconditioner's blocks and what GMRES keeps. Cost: 0.1 s for 65 000 vertices.
double predicted_solvation_bytes(const DiscreteSurface& surface, const Molecule& molecule, const SolvationOptions& options);

}  // namespace smopt::metrics
