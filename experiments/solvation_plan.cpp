#include "experiments/solvation_plan.h"

#include "experiments/method_cases.h"

namespace smopt::experiments {

std::string why_no_solvation(const Dataset& dataset, std::string_view method, const SolvationSettings& settings) {
  if (dataset.path.empty()) return "no molecule";
  if (method != kInitial && method != kSmopt) return "only for Table 1";
  if (!dataset.has_solvation) return "not for this molecule";
  if (settings.is_quick && !dataset.is_in(kQuickSuite)) return "not in a quick run";
  return "";
}

}  // namespace smopt::experiments
