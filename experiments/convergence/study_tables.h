#pragma once

#include <span>
#include <string>

#include "experiments/convergence/molecule_study.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// A molecule's surfaces, error by error, and those of the uniform grids.
Table convergence_table(const MoleculeStudy& study);

/// What area and volume of each molecule tend to, and the topology at the least error.
Table limit_table(std::span<const MoleculeStudy> studies);

/// How many places changed their topology in each step, and how they are explained.
Table change_table(std::span<const MoleculeStudy> studies);

/// What happened at critical points, counted.
Table event_table(std::span<const MoleculeStudy> studies);

/// The changes with the largest |φ − c| for their error: `least` of them, and all with more than E implies.
Table hardest_changes_table(std::span<const MoleculeStudy> studies, std::size_t least);

/// The published program's meshes, ours of about as many vertices, the uniform grid's, and the limit.
Table published_table(std::span<const MoleculeStudy> studies);

/// A histogram of edge ratios as lines of text, a tenth a line: "0.0–0.1  12.3 %  ████".
std::string edge_ratio_bars(const metrics::Histogram& histogram);

}  // namespace smopt::experiments
