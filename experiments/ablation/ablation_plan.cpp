#include "experiments/ablation/ablation_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "baselines/baselines.h"
#include "experiments/ablation/embedded.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> parsed_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Names become parts of file names, where a + stands between two of them.
void require_file_name(const std::string& name) {
  const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
  });
  if (!is_plain) throw InvalidInput(fmt::format("'{}' is no name: lower-case letters, digits, - and . only", name));
}

Level parse_level(const Json& json, const std::string& unit) {
  Level level;
  level.name = json.at("name").get<std::string>();
  require_file_name(level.name);
  level.title = json.value("title", level.name + (unit.empty() || unit == "°" ? unit : " " + unit));
  level.options = json.value("options", level.options);
  level.cavities = json.value("cavities", "");
  level.value = parsed_number(level.name);
  return level;
}

template <class T>
std::size_t place_of(const std::vector<T>& list, const std::string& name, const char* what) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const T& entry) { return entry.name == name; });
  if (found == list.end()) throw InvalidInput(fmt::format("no {} '{}'", what, name));
  return static_cast<std::size_t>(found - list.begin());
}

void require_settings_of(const Method& method, const Level& level, bool is_default) {
  static_cast<void>(OptionValues(method.options, level.options));  // throws for what the method does not know
  if (!level.cavities.empty()) static_cast<void>(parse_cavity_policy(level.cavities));
  if (!is_default) return;
  const OptionValues defaults(method.options, {});
  for (const auto& [option, value] : level.options)
    if (defaults.text(option) != value)
      throw InvalidInput(fmt::format("the default level has {} {}, the method {}", option, value, defaults.text(option)));
  if (!level.cavities.empty() && level.cavities != to_string(method.default_cavities))
    throw InvalidInput(fmt::format("the default level has cavities {}, the method {}", level.cavities, to_string(method.default_cavities)));
}

Factor parse_factor(const Json& json, const Method& method) {
  Factor factor;
  factor.name = json.at("name").get<std::string>();
  require_file_name(factor.name);
  factor.title = json.at("title").get<std::string>();
  factor.about = json.at("about").get<std::string>();
  factor.unit = json.value("unit", "");
  for (const Json& level : json.at("levels")) factor.levels.push_back(parse_level(level, factor.unit));
  factor.default_level = place_of(factor.levels, json.at("default").get<std::string>(), "level");
  for (std::size_t i = 0; i < factor.levels.size(); ++i) {
    if (place_of(factor.levels, factor.levels[i].name, "level") != i)
      throw InvalidInput(fmt::format("level '{}' is there twice", factor.levels[i].name));
    require_settings_of(method, factor.levels[i], i == factor.default_level);
  }
  return factor;
}

std::vector<std::size_t> parse_levels(const Json& json, const Factor& factor) {
  std::vector<std::size_t> levels;
  if (json == "all")
    for (std::size_t i = 0; i < factor.levels.size(); ++i) levels.push_back(i);
  else
    for (const Json& name : json) levels.push_back(place_of(factor.levels, name.get<std::string>(), "level"));
  if (std::set(levels.begin(), levels.end()).size() != levels.size()) throw InvalidInput("a level is there twice");
  if (std::find(levels.begin(), levels.end(), factor.default_level) == levels.end())
    throw InvalidInput(fmt::format("the default, {}, is not among the levels", factor.levels[factor.default_level].name));
  return levels;
}

std::vector<VariedFactor> parse_design(const Json& json, const std::vector<Factor>& factors) {
  std::vector<VariedFactor> design;
  for (const auto& [name, levels] : json.items()) {
    try {
      const std::size_t factor = place_of(factors, name, "factor");
      design.push_back({factor, parse_levels(levels, factors[factor])});
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("factor {}: {}", name, error.what()));
    }
  }
  return design;
}

std::set<std::string> settings_of(const VariedFactor& varied, const std::vector<Factor>& factors) {
  std::set<std::string> settings;
  for (const std::size_t level : varied.levels) {
    for (const auto& [option, value] : factors[varied.factor].levels[level].options) settings.insert(option);
    if (!factors[varied.factor].levels[level].cavities.empty()) settings.insert("cavities");
  }
  return settings;
}

/// Where factors are varied together, or a case would not be what its levels say.
void require_independent(const std::vector<VariedFactor>& design, const std::vector<Factor>& factors) {
  std::map<std::string, std::string> set_by;
  for (const VariedFactor& varied : design) {
    const std::string& name = factors[varied.factor].name;
    for (const std::string& setting : settings_of(varied, factors))
      if (const auto [other, is_new] = set_by.emplace(setting, name); !is_new)
        throw InvalidInput(fmt::format("factor {}: {} is set by {} too", name, setting, other->second));
  }
}

void require_grid(const std::vector<VariedFactor>& design, const std::vector<Factor>& factors) {
  if (design.size() != 2) throw InvalidInput(fmt::format("expected two factors, got {}", design.size()));
  for (const auto& [factor, levels] : design)
    for (const std::size_t level : levels)
      if (!factors[factor].levels[level].value)
        throw InvalidInput(fmt::format("factor {}: {} is no number", factors[factor].name, factors[factor].levels[level].name));
}

/// Does something for an entry; what is wrong with it is told with the entry's name.
template <class Do>
void in_entry(const std::string& entry, const Do& act) {
  try {
    act();
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("ablation: {}: {}", entry, error.what()));
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("ablation: {}: {}", entry, error.what()));
  } catch (const InvalidOption& error) {
    throw InvalidInput(fmt::format("ablation: {}: {}", entry, error.what()));
  }
}

Json parsed(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("ablation: {}", error.what()));
  }
}

void parse_factors(const Json& json, AblationPlan& plan) {
  const Method& method = baselines::all_methods().find(plan.method);
  for (std::size_t i = 0; i < json.size(); ++i) {
    in_entry(fmt::format("factor {} ({})", i, json[i].value("name", "no name")), [&] {
      plan.factors.push_back(parse_factor(json[i], method));
      if (place_of(plan.factors, plan.factors.back().name, "factor") != i) throw InvalidInput("is there twice");
    });
  }
}

void parse_designs(const Json& json, AblationPlan& plan) {
  in_entry("one-at-a-time", [&] { plan.one_at_a_time = parse_design(json.at("one-at-a-time"), plan.factors); });
  in_entry("factorial", [&] {
    plan.factorial = parse_design(json.at("factorial"), plan.factors);
    require_independent(plan.factorial, plan.factors);
  });
  in_entry("thresholds", [&] {
    plan.thresholds = parse_design(json.at("thresholds"), plan.factors);
    require_grid(plan.thresholds, plan.factors);
    require_independent(plan.thresholds, plan.factors);
  });
}

}  // namespace

AblationPlan parse_ablation_plan(std::string_view text, bool is_quick) {
  const Json json = parsed(text);
  AblationPlan plan;
  in_entry("method", [&] {
    plan.method = json.at("method").get<std::string>();
    static_cast<void>(baselines::all_methods().find(plan.method));  // throws where there is none
  });
  in_entry("molecules", [&] { plan.molecules = json.at(is_quick ? "quick_molecules" : "molecules").get<std::vector<std::string>>(); });
  in_entry("factors", [&] { static_cast<void>(json.at("factors").at(0)); });
  parse_factors(json.at("factors"), plan);
  const char* const designs = is_quick ? "quick_designs" : "designs";
  in_entry(designs, [&] { static_cast<void>(json.at(designs)); });
  parse_designs(json.at(designs), plan);
  return plan;
}

const AblationPlan& ablation_plan(bool is_quick) {
  static const AblationPlan full = parse_ablation_plan(embedded::ablation_json(), false);
  static const AblationPlan quick = parse_ablation_plan(embedded::ablation_json(), true);
  return is_quick ? quick : full;
}

}  // namespace smopt::experiments
