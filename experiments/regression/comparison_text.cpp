#include "experiments/regression/comparison_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const CaseName& name) {
  return fmt::format("{}, {}", name.molecule, name.method);
}

bool is_number(const RecordValue& value) {
  return std::holds_alternative<double>(value);
}

/// "  fas2, smopt: angle_deg.min 10.2° → 9.1° (tolerance 0.25°)".
std::string line_of(const Difference& difference) {
  const std::string tolerance =
      is_number(difference.reference)
          ? fmt::format(" (tolerance {})", text_of(difference.slack, difference.unit == "change" ? "share" : difference.unit))
          : "";
  const std::string reason = difference.reason.empty() ? "" : fmt::format(": {}", difference.reason);
  return fmt::format("  {}: {} {} → {}{}{}\n", name_of(difference.of), difference.quantity, text_of(difference.reference, difference.unit),
                     text_of(difference.now, difference.unit), reason, tolerance);
}

std::string line_of(const CaseRemark& remark) {
  return fmt::format("  {}: {}\n", name_of(remark.of), remark.text);
}

std::string line_of(const CaseName& name) {
  return fmt::format("  {}\n", name_of(name));
}

/// Nothing where the list is empty.
template <class List>
std::string section(const char* title, const List& list) {
  if (list.empty()) return {};
  std::string text = fmt::format("{}:\n", title);
  for (const auto& item : list) text += line_of(item);
  return text + "\n";
}

std::string verdict_of(const Comparison& comparison, bool complete) {
  const std::size_t missing = complete ? comparison.only_in_reference.size() : 0;
  return fmt::format("{}: {} cases, {} values compared: {} worse, {} better{}\n", is_red(comparison, complete) ? "RED" : "GREEN",
                     comparison.compared.size(), comparison.values, comparison.worse.size(), comparison.better.size(),
                     missing > 0 ? fmt::format(", {} cases missing", missing) : "");
}

Json json_of(const RecordValue& value) {
  if (const auto* const number = std::get_if<double>(&value)) return *number;
  if (const auto* const word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}

Json json_of(const CaseName& name) {
  return {{"molecule", name.molecule}, {"method", name.method}};
}

Json json_of(const CaseRemark& remark) {
  Json json = json_of(remark.of);
  json["text"] = remark.text;
  return json;
}

Json json_of(const Difference& difference) {
  Json json = json_of(difference.of);
  json["quantity"] = difference.quantity;
  json["unit"] = difference.unit;
  json["reference"] = json_of(difference.reference);
  json["now"] = json_of(difference.now);
  json["tolerance"] = is_number(difference.reference) ? Json(difference.slack) : Json();
  json["reason"] = difference.reason.empty() ? Json() : Json(difference.reason);
  json["why"] = difference.why;
  return json;
}

template <class List>
Json array_of(const List& list) {
  Json json = Json::array();
  for (const auto& item : list) json.push_back(json_of(item));
  return json;
}

}  // namespace

std::string to_text(const Comparison& comparison, bool complete) {
  return section("Worse", comparison.worse) + section("Better", comparison.better) + section("Shown only, never red", comparison.shown) +
         section("Not given the same", comparison.changed) + section("Not compared", comparison.not_compared) +
         section("Only in the run", comparison.only_in_run) +
         section(complete ? "Missing in the run" : "Only in the reference", comparison.only_in_reference) +
         verdict_of(comparison, complete);
}

Json to_json(const Comparison& comparison, bool complete) {
  return {{"verdict", is_red(comparison, complete) ? "red" : "green"},
          {"cases", comparison.compared.size()},
          {"values", comparison.values},
          {"worse", array_of(comparison.worse)},
          {"better", array_of(comparison.better)},
          {"shown", array_of(comparison.shown)},
          {"changed", array_of(comparison.changed)},
          {"not_compared", array_of(comparison.not_compared)},
          {"only_in_run", array_of(comparison.only_in_run)},
          {"only_in_reference", array_of(comparison.only_in_reference)}};
}

}  // namespace smopt::experiments
