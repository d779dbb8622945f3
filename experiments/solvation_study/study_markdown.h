#pragma once

#include <string>

#include "experiments/solvation_study/study.h"

namespace smopt::experiments {

/// The page results/solvation.md. \param command  by which it was made.
std::string study_markdown(const SolvationStudy& study, const std::string& command);

}  // namespace smopt::experiments
