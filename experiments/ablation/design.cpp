#include "experiments/ablation/design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace smopt::experiments {
namespace {

constexpr const char* kDefaultName = "default";
constexpr const char* kDefaultTitle = "all defaults";

std::vector<DesignCase> distinct(const std::vector<std::vector<DesignCase>>& designs) {
  std::set<std::string> names;
  std::vector<DesignCase> cases;
  for (const std::vector<DesignCase>& design : designs)
    for (const DesignCase& design_case : design)
      if (names.insert(design_case.method_case.name).second) cases.push_back(design_case);
  return cases;
}

}  // namespace

std::vector<std::size_t> default_levels(const AblationPlan& plan) {
  std::vector<std::size_t> levels;
  for (const Factor& factor : plan.factors) levels.push_back(factor.default_level);
  return levels;
}

DesignCase design_case(const AblationPlan& plan, const std::vector<std::size_t>& levels) {
  DesignCase result;
  result.levels = levels;
  result.method_case.is_timed = true;
  result.method_case.is_ablation = true;
  result.method_case.method = plan.method;
  std::vector<std::string> names, titles;
  for (std::size_t i = 0; i < plan.factors.size(); ++i) {
    const Factor& factor = plan.factors[i];
    if (levels[i] == factor.default_level) continue;
    const Level& level = factor.levels[levels[i]];
    names.push_back(factor.name + "-" + level.name);
    titles.push_back(factor.title + ": " + level.title);
    for (const auto& [option, value] : level.options) result.method_case.options[option] = value;
    if (!level.cavities.empty()) result.method_case.cavities = level.cavities;
  }
  result.method_case.name = names.empty() ? kDefaultName : fmt::format("{}", fmt::join(names, "+"));
  result.method_case.title = titles.empty() ? kDefaultTitle : fmt::format("{}", fmt::join(titles, "; "));
  return result;
}

std::vector<DesignCase> one_at_a_time(const AblationPlan& plan, const std::vector<VariedFactor>& varied) {
  const std::vector<std::size_t> defaults = default_levels(plan);
  std::vector<DesignCase> cases = {design_case(plan, defaults)};
  for (const auto& [factor, levels] : varied) {
    for (const std::size_t level : levels) {
      if (level == defaults[factor]) continue;
      std::vector<std::size_t> changed = defaults;
      changed[factor] = level;
      cases.push_back(design_case(plan, changed));
    }
  }
  return cases;
}

std::vector<DesignCase> full_factorial(const AblationPlan& plan, const std::vector<VariedFactor>& varied) {
  std::vector<std::vector<std::size_t>> combinations = {default_levels(plan)};
  for (const auto& [factor, levels] : varied) {
    std::vector<std::vector<std::size_t>> longer;
    for (const std::vector<std::size_t>& combination : combinations) {
      for (const std::size_t level : levels) {
        longer.push_back(combination);
        longer.back()[factor] = level;
      }
    }
    combinations = std::move(longer);
  }
  std::vector<DesignCase> cases;
  for (const std::vector<std::size_t>& combination : combinations) cases.push_back(design_case(plan, combination));
  return cases;
}

std::vector<DesignCase> chosen_cases(const AblationPlan& plan, const ChosenDesigns& designs) {
  std::vector<std::vector<DesignCase>> chosen;
  if (designs.one_at_a_time) chosen.push_back(one_at_a_time(plan, plan.one_at_a_time));
  if (designs.factorial) chosen.push_back(full_factorial(plan, plan.factorial));
  if (designs.thresholds) chosen.push_back(full_factorial(plan, plan.thresholds));
  return distinct(chosen);
}

}  // namespace smopt::experiments
