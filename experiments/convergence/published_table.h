#pragma once

#include <span>

#include "experiments/convergence/molecule_study.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// The published program's meshes, ours of about as many vertices, the uniform grid's, and the limit.
Table published_table(std::span<const MoleculeStudy> studies);

}  // namespace smopt::experiments
