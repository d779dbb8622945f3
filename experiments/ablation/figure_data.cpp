#include "experiments/ablation/figure_data.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json quantities_json() {
  Json list = Json::array();
  for (const Quantity& quantity : ablation_quantities())
    list.push_back({{"id", quantity.id},
                    {"title", quantity.title},
                    {"decimals", quantity.decimals},
                    {"scale", to_string(quantity.scale)},
                    {"linear_to", quantity.linear_to},
                    {"noticeable", quantity.noticeable}});
  return list;
}

/// `values` and `missing` of some cases: by case, then by quantity.
Json values_json(const Outcomes& outcomes, const std::vector<DesignCase>& cases) {
  Json values = Json::object(), missing = Json::object();
  for (const DesignCase& design_case : cases) {
    const std::string& name = design_case.method_case.name;
    for (const Quantity& quantity : ablation_quantities()) {
      values[name][quantity.id] = number_or_null(outcomes.value(quantity, name));
      if (const std::string why = outcomes.why_no_value(quantity, name); !why.empty()) missing[name][quantity.id] = why;
    }
  }
  return {{"title", outcomes.title()}, {"values", values}, {"missing", missing}};
}

Json given_json(const Outcomes& outcomes) {
  Json given;
  for (const Quantity& quantity : ablation_quantities()) given[quantity.id] = number_or_null(outcomes.given(quantity));
  return given;
}

Json factor_json(const AblationPlan& plan, const VariedFactor& varied) {
  const Factor& factor = plan.factors[varied.factor];
  Json levels = Json::array();
  for (const std::size_t level : varied.levels)
    levels.push_back({{"title", factor.levels[level].title},
                      {"value", number_or_null(factor.levels[level].value)},
                      {"is_default", level == factor.default_level}});
  return {{"name", factor.name}, {"title", factor.title}, {"unit", factor.unit}, {"levels", levels}};
}

Json factors_json(const AblationPlan& plan, const std::vector<VariedFactor>& varied) {
  Json factors = Json::array();
  for (const VariedFactor& factor : varied) factors.push_back(factor_json(plan, factor));
  return factors;
}

Json one_at_a_time_json(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Json factors = Json::array();
  for (const auto& [factor, levels] : plan.one_at_a_time) {
    Json cases = Json::array();
    for (const std::size_t level : levels) {
      std::vector<std::size_t> changed = default_levels(plan);
      if (changed[factor] == level) continue;
      changed[factor] = level;
      cases.push_back({{"case", design_case(plan, changed).method_case.name}, {"title", plan.factors[factor].levels[level].title}});
    }
    factors.push_back({{"title", plan.factors[factor].title}, {"cases", cases}});
  }
  Json rows = Json::array();
  for (const Outcomes& outcomes : molecules) {
    Json row = values_json(outcomes, one_at_a_time(plan, plan.one_at_a_time));
    row["given"] = given_json(outcomes);
    rows.push_back(std::move(row));
  }
  return {{"default", design_case(plan, default_levels(plan)).method_case.name}, {"factors", factors}, {"molecules", rows}};
}

/// `level_means`, by factor and level, and `shares`, by factor and factor.
Json effects_json(const Quantity& quantity, const Effects& effects) {
  Json means = Json::array(), shares = Json::array(), left_out = Json::array();
  for (std::size_t factor = 0; factor < effects.level_means.size(); ++factor) {
    Json& of_factor = means.emplace_back(Json::array());
    for (std::size_t level = 0; level < effects.level_means[factor].size(); ++level)
      of_factor.push_back(number_or_null(level_mean(quantity, effects, factor, level)));
    Json& row = shares.emplace_back(Json::array());
    for (const std::optional<double>& share : effects.shares[factor]) row.push_back(number_or_null(share));
  }
  for (const auto& [factor, level] : effects.left_out) left_out.push_back({{"factor", factor}, {"level", level}});
  return {{"level_means", means}, {"shares", shares}, {"rest_share", number_or_null(effects.rest_share)}, {"left_out", left_out}};
}

bool varies_noticeably(const Quantity& quantity, const Outcomes& outcomes, const AblationPlan& plan) {
  const auto range = range_over(quantity, outcomes, full_factorial(plan, plan.factorial));
  return range && is_noticeable(quantity, range->second, range->first);
}

Json factorial_json(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Json rows = Json::array();
  for (const Outcomes& outcomes : molecules) {
    Json effects = Json::object();
    for (const Quantity& quantity : ablation_quantities()) {
      const std::optional<Effects> found = effects_on(quantity, outcomes, plan, plan.factorial);
      effects[quantity.id] = found ? effects_json(quantity, *found) : Json();
      if (found) effects[quantity.id]["is_noticeable"] = varies_noticeably(quantity, outcomes, plan);
    }
    rows.push_back({{"title", outcomes.title()}, {"effects", effects}});
  }
  return {{"factors", factors_json(plan, plan.factorial)}, {"molecules", rows}};
}

/// The grid's cases by the first factor's level and then by the second's.
Json thresholds_json(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  const std::vector<DesignCase> cases = full_factorial(plan, plan.thresholds);
  Json names = Json::array();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (i % plan.thresholds[1].levels.size() == 0) names.push_back(Json::array());
    names.back().push_back(cases[i].method_case.name);
  }
  Json rows = Json::array();
  for (const Outcomes& outcomes : molecules) rows.push_back(values_json(outcomes, cases));
  return {{"factors", factors_json(plan, plan.thresholds)}, {"cases", names}, {"molecules", rows}};
}

}  // namespace

Json figure_data(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs) {
  return {{"quantities", quantities_json()},
          {"one_at_a_time", designs.one_at_a_time ? one_at_a_time_json(plan, molecules) : Json()},
          {"factorial", designs.factorial ? factorial_json(plan, molecules) : Json()},
          {"thresholds", designs.thresholds ? thresholds_json(plan, molecules) : Json()}};
}

}  // namespace smopt::experiments
