#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/ablation/ablation_plan.h"
#include "experiments/ablation/outcomes.h"

namespace smopt::experiments {

/// All that the figures show, as numbers: `quantities`, and `one_at_a_time`, `factorial` and `thresholds`, null where the design is not in the
/// study. Each has the factors, and per molecule the values (or means and shares), null where there is none; `missing` says why, by case and
/// quantity.
nlohmann::ordered_json figure_data(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs);

}  // namespace smopt::experiments
