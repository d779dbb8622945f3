#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/ablation/ablation_plan.h"
#include "experiments/method_cases.h"

namespace smopt::experiments {

/// A case of a design: the method with one level of every factor.
struct DesignCase {
  MethodCase method_case;           ///< "default", or what is not: "guard-none+redundant-keep"
  std::vector<std::size_t> levels;  ///< of every factor of the plan
};

/// The case in which each factor of the plan has these levels. Equal levels give an equal name, whichever design asks for them.
DesignCase design_case(const AblationPlan& plan, const std::vector<std::size_t>& levels);

/// All factors at their defaults.
std::vector<std::size_t> default_levels(const AblationPlan& plan);

/// The default, then each varied factor alone at each of its other levels.
std::vector<DesignCase> one_at_a_time(const AblationPlan& plan, const std::vector<VariedFactor>& varied);

/// Every combination of the varied factors' levels, the last factor's changing fastest; the other factors stay at their defaults.
std::vector<DesignCase> full_factorial(const AblationPlan& plan, const std::vector<VariedFactor>& varied);

/// Which designs a study has.
struct ChosenDesigns {
  bool one_at_a_time = true;
  bool factorial = true;
  bool thresholds = true;
};

/// The cases of the plan's chosen designs, each once, in the order in which they come first.
std::vector<DesignCase> chosen_cases(const AblationPlan& plan, const ChosenDesigns& designs);

}  // namespace smopt::experiments
