#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "experiments/convergence/molecule_study.h"

namespace smopt::experiments {

/// All figures of the study, with every change of topology. Lengths in ångström.
nlohmann::ordered_json study_json(std::span<const MoleculeStudy> studies);

}  // namespace smopt::experiments
