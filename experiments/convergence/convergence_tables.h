#pragma once

#include <span>

#include "experiments/convergence/molecule_study.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// A molecule's surfaces, error by error, and those of the uniform grids.
Table convergence_table(const MoleculeStudy& study);

/// What area and volume of each molecule tend to, and the topology at the least error.
Table limit_table(std::span<const MoleculeStudy> studies);

}  // namespace smopt::experiments
