#pragma once

#include <string>
#include <vector>

#include "experiments/solvation_study/study.h"

namespace smopt::experiments {

/// What the study shows, a sentence each, drawn from its numbers: whether each thing that was asked of the solver holds.
std::vector<std::string> findings(const SolvationStudy& study);

}  // namespace smopt::experiments
