#include "experiments/regression/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/embedded.h"
#include "metrics/registry.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 19> kKeys = {"not_asked", "metrics", "quantity",   "at",          "unit",
                                                    "better",    "to",      "best_first", "change_from", "absolute",
                                                    "relative",  "methods", "molecules",  "where",       "needs_same_options",
                                                    "gates",     "why",     "is",         "limited_by"};

/// What a machine and its load decide: never a reason to be red.
constexpr std::array<std::string_view, 3> kNeverGating = {"seconds", "memory", "threads"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "angle_deg.min" → "/metrics/after/angle_deg/min"; the dot of "edge_ratio.below_0.1" between two digits is part of a number.
std::string pointer_of_metric(std::string_view name) {
  std::string pointer = "/metrics/after/";
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_in_number = i + 1 < name.size() && std::isdigit(static_cast<unsigned char>(name[i + 1])) != 0;
    pointer += name[i] == '.' && !is_in_number ? '/' : name[i];
  }
  return pointer;
}

Direction direction_of(metrics::Better better) {
  switch (better) {
    case metrics::Better::kHigher:
      return Direction::higher;
    case metrics::Better::kLower:
      return Direction::lower;
    case metrics::Better::kNeutral:
      break;
  }
  return Direction::equal;
}

Direction direction_named(const std::string& name) {
  for (const auto& [text, direction] : {std::pair("lower", Direction::lower), std::pair("higher", Direction::higher),
                                        std::pair("equal", Direction::equal), std::pair("nearer", Direction::nearer)})
    if (name == text) return direction;
  throw InvalidInput(fmt::format("better is lower, higher, equal or nearer, not '{}'", name));
}

/// A pointer that can be followed.
std::string pointer_at(const Json& entry, const char* key) {
  std::string pointer = entry.value(key, "");
  static_cast<void>(Json::json_pointer(pointer));  // throws where it is none
  return pointer;
}

double tolerance_at(const Json& entry, const char* key) {
  const double value = entry.value(key, 0.0);
  if (!(value >= 0)) throw InvalidInput(fmt::format("{} is a number that is not negative", key));
  return value;
}

void require_known_keys(const Json& entry) {
  for (const auto& [key, value] : entry.items())
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) throw InvalidInput(fmt::format("unknown key '{}'", key));
}

/// All that the entry's quantities have in common.
Tolerance common_part(const Json& entry) {
  Tolerance tolerance;
  tolerance.change_from = pointer_at(entry, "change_from");
  tolerance.absolute = tolerance_at(entry, "absolute");
  tolerance.relative = tolerance_at(entry, "relative");
  tolerance.target = entry.value("to", 0.0);
  tolerance.methods = entry.value("methods", tolerance.methods);
  tolerance.molecules = entry.value("molecules", tolerance.molecules);
  tolerance.condition_pointer = pointer_at(entry, "where");
  tolerance.condition_text = entry.value("is", "");
  tolerance.needs_same_options = entry.value("needs_same_options", false);
  tolerance.gates = entry.value("gates", true);
  tolerance.why = entry.at("why").get<std::string>();
  if (tolerance.why.empty()) throw InvalidInput("why must be said");
  return tolerance;
}

/// The registry knows its direction and its unit; only of a metric that has no better direction may the entry say one.
Tolerance of_metric(Tolerance tolerance, const Json& entry, const std::string& name) {
  const metrics::Metric* const metric = metrics::find_metric(name);
  if (metric == nullptr) throw InvalidInput(fmt::format("'{}' is no metric", name));
  if (metric->better != metrics::Better::kNeutral && entry.contains("better"))
    throw InvalidInput(fmt::format("the direction of {} is that of the registry of metrics", name));
  tolerance.quantity = name;
  tolerance.pointer = pointer_of_metric(name);
  tolerance.unit = metric->unit;
  tolerance.direction = entry.contains("better") ? direction_named(entry.at("better")) : direction_of(metric->better);
  return tolerance;
}

Tolerance of_other_quantity(Tolerance tolerance, const Json& entry) {
  tolerance.quantity = entry.at("quantity").get<std::string>();
  tolerance.pointer = pointer_at(entry, "at");
  tolerance.unit = tolerance.change_from.empty() ? entry.value("unit", "1") : "change";
  tolerance.best_first = entry.value("best_first", tolerance.best_first);
  tolerance.not_asked = entry.value("not_asked", tolerance.not_asked);
  tolerance.limited_by = entry.value("limited_by", tolerance.limited_by);
  if (tolerance.pointer.empty()) throw InvalidInput(fmt::format("{}: at says where it stands in a record", tolerance.quantity));
  tolerance.direction = tolerance.best_first.empty() ? direction_named(entry.at("better")) : Direction::ranked;
  return tolerance;
}

void require_gating_is_fair(const Tolerance& tolerance) {
  for (const std::string_view word : kNeverGating)
    if (tolerance.gates && tolerance.pointer.find(word) != std::string::npos)
      throw InvalidInput(fmt::format("{}: times and memory never gate", tolerance.quantity));
}

std::vector<Tolerance> parse_entry(const Json& entry) {
  require_known_keys(entry);
  const Tolerance common = common_part(entry);
  std::vector<Tolerance> result;
  if (entry.contains("metrics"))
    for (const Json& name : entry.at("metrics")) result.push_back(of_metric(common, entry, name));
  else
    result.push_back(of_other_quantity(common, entry));
  for (const Tolerance& tolerance : result) require_gating_is_fair(tolerance);
  return result;
}

bool is_in_scope(const Tolerance& tolerance, const CaseKey& key) {
  const bool is_for_method =
      tolerance.methods.empty() || contains(tolerance.methods, key.method) || contains(tolerance.methods, key.registered_method);
  return is_for_method && (tolerance.molecules.empty() || contains(tolerance.molecules, key.molecule));
}

}  // namespace

double slack(const Tolerance& tolerance, double reference) {
  return std::max(tolerance.absolute, tolerance.relative * std::abs(reference));
}

std::vector<Tolerance> parse_tolerances(std::string_view text, std::string_view source) {
  std::vector<Tolerance> tolerances;
  std::size_t entry = 0;
  try {
    const Json json = Json::parse(text);
    for (const Json& item : json.at("tolerances")) {
      ++entry;
      for (Tolerance& tolerance : parse_entry(item)) tolerances.push_back(std::move(tolerance));
    }
  } catch (const std::exception& error) {
    throw InvalidInput(fmt::format("{}: entry {}: {}", source, entry, error.what()));
  }
  return tolerances;
}

const std::vector<Tolerance>& default_tolerances() {
  static const std::vector<Tolerance> tolerances = parse_tolerances(embedded::tolerances_json(), "tolerances.json");
  return tolerances;
}

std::vector<const Tolerance*> tolerances_for(const std::vector<Tolerance>& tolerances, const CaseKey& key) {
  std::vector<const Tolerance*> result;
  std::set<std::string> seen;
  for (const Tolerance& tolerance : tolerances)
    if (is_in_scope(tolerance, key) && seen.insert(tolerance.quantity).second) result.push_back(&tolerance);
  return result;
}

}  // namespace smopt::experiments
