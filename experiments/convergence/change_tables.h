#pragma once

#include <cstddef>
#include <span>

#include "experiments/convergence/molecule_study.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// How many places changed their topology in each step, and how they are explained.
Table change_table(std::span<const MoleculeStudy> studies);

/// What happened at critical points, counted.
Table event_table(std::span<const MoleculeStudy> studies);

/// The changes with the largest |φ − c| for their error: `least` of them, and all with more than E implies.
Table hardest_changes_table(std::span<const MoleculeStudy> studies, std::size_t least);

}  // namespace smopt::experiments
