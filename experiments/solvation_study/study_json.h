#pragma once

#include <nlohmann/json.hpp>

#include "experiments/solvation_study/study.h"

namespace smopt::experiments {

/// All figures of the study, its findings and the machine. Lengths in ångström, energies in kcal/mol.
nlohmann::ordered_json study_json(const SolvationStudy& study);

}  // namespace smopt::experiments
