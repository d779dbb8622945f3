#pragma once

#include <vector>

#include "experiments/ablation/ablation_plan.h"
#include "experiments/ablation/outcomes.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// A row for the mesh as it was given, one for the default, and one for each level of each factor alone; of every molecule.
Table one_at_a_time_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules);

/// Per factor and level the mean of each quantity over all cases of the factorial design with that level.
Table main_effects_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules);

/// Per factor and per two factors what part of each quantity's variation is theirs, in per cent.
Table interactions_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules);

/// Every case of the factorial design, and every case of the grid of thresholds.
Table factorial_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules);
Table thresholds_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules);

}  // namespace smopt::experiments
