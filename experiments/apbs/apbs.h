#pragma once

#include <string>

#include "experiments/apbs/apbs_input.h"
#include "smopt/io/child_process.h"
#include "smopt/progress.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {

struct ApbsOptions {
  metrics::DielectricModel medium;
  ApbsSurface surface = ApbsSurface::molecular;
  double spacing = 0.5;                    ///< of the grid, Å; positive
  GaussianSurfaceOptions gaussian;         ///< decay and isovalue of a Gaussian surface
  ProcessLimits limits = {1800, 8192, 0};  ///< 225³ nodes take a minute and 2.6 to 4.5 GB
};

struct ApbsResult {
  double polar = 0;  ///< kcal/mol
  ApbsGrid grid;
  double seconds = 0;         ///< wall time
  double peak_memory_mb = 0;  ///< as seen each 50 ms
};

/// Whether there is a program `apbs` in PATH.
bool has_apbs();

/// The polar solvation energy of a molecule by finite differences: APBS (Baker et al. 2001, PNAS 98:10037; Jurrus et al. 2018, Protein Sci. 27:112),
/// where it is installed (Debian: apbs), in a process of its own. Reads nothing but the molecule's centres, charges and radii.
///
/// The energy approaches its limit slowly, at about first order, from larger amounts. Measured (spacing in Å: kcal/mol), fas2 with its Gaussian surface
/// 0.6: -392.2, 0.42: -386.3, 0.3: -382.6; the AChE monomer 0.6: -2252.5, 0.42: -2216.5 (257 × 225 × 193 nodes, 21 s, 2.7 GB); fas2 with the molecular
/// surface, mean of three unequal spacings, 0.61: -503, 0.46: -493, 0.37: -487, 0.26: -483.
/// \throws NotInstalled; MethodFailed with the reason; InvalidInput for a molecule without atoms; InvalidOption; Cancelled.
ApbsResult run_apbs(const Molecule& molecule, const ApbsOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace smopt::experiments
