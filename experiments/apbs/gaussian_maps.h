#pragma once

#include <filesystem>

#include "experiments/apbs/apbs_input.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {

/// Writes `kApbsMaps` for the Gaussian surface φ = c into a folder, in OpenDX's form: inside, where φ ≥ c, the solute's permittivity and no ions;
/// outside the solvent's. A cavity is outside, as in the generated mesh. Decay and isovalue are read of the options.
/// \throws InvalidInput for what the field refuses, or when a file cannot be written. Cost: four samplings of the field and 12 bytes a node of files.
void write_gaussian_maps(const std::filesystem::path& folder, const Molecule& molecule, const GaussianSurfaceOptions& surface,
                         const metrics::DielectricModel& medium, const ApbsGrid& grid);

}  // namespace smopt::experiments
