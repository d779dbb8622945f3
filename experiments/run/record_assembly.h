#pragma once

#include <filesystem>

#include "experiments/record.h"
#include "experiments/run/run_plan.h"

namespace smopt::experiments {

/// The record of a case, from what its steps left behind: its reports where they ended well, its reason where one without which there is no result
/// did not. TetGen and the solver that fail are entries with their reasons. \throws InvalidInput when a step's report cannot be read.
Json assemble_record(const CasePlan& planned, const RunPlan& plan, const std::filesystem::path& directory);

}  // namespace smopt::experiments
