#pragma once

#include <string>
#include <vector>

#include "experiments/ablation/ablation_plan.h"
#include "experiments/ablation/outcomes.h"

/// What the numbers of the study say, in sentences. Each sentence is made from the records of one molecule.
namespace smopt::experiments {

/// What all of SMOPT together does: the mesh before and after, with all defaults.
std::string whole_finding(const AblationPlan& plan, const Outcomes& outcomes);

/// Per factor, and per level other than the default: what changes noticeably (see Quantity::noticeable), or that nothing does, or why there is no
/// result.
struct FactorFinding {
  std::string title;
  std::string about;
  std::vector<std::string> sentences;
};
std::vector<FactorFinding> one_at_a_time_findings(const AblationPlan& plan, const Outcomes& outcomes);

/// Per quantity the single change that does the most to it; a quantity that no change moves is said to be moved by none.
std::vector<std::string> largest_change_findings(const AblationPlan& plan, const Outcomes& outcomes);

/// Per quantity the factor with the largest main effect and the two with the strongest interaction, with their parts of the variation.
std::vector<std::string> factorial_findings(const AblationPlan& plan, const Outcomes& outcomes);

/// Per quantity the smallest and the largest value over the grid of thresholds, where they are, and the default's.
std::vector<std::string> threshold_findings(const AblationPlan& plan, const Outcomes& outcomes);

/// Cases that did not end well, with the reason.
std::vector<std::string> failures(const std::vector<DesignCase>& cases, const Outcomes& outcomes);

}  // namespace smopt::experiments
