#pragma once

#include <string>
#include <vector>

#include "experiments/ablation/ablation_plan.h"
#include "experiments/ablation/figure_data.h"
#include "experiments/ablation/outcomes.h"

namespace smopt::experiments {

/// The page of a study, as Markdown: what each part contributes, in words, with links to its tables and figures.
std::string ablation_page(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs);

}  // namespace smopt::experiments
