#include "experiments/method_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/embedded.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::json;

MethodCase parse_case(const Json& json) {
  MethodCase result;
  result.name = json.at("name").get<std::string>();
  result.title = json.at("title").get<std::string>();
  result.method = json.value("method", result.name);
  result.options = json.value("options", result.options);
  result.vertices_of = json.value("vertices_of", "");
  result.cavities = json.value("cavities", result.cavities);
  result.is_timed = json.value("is_timed", false);
  result.is_in_paper_tables = json.value("is_in_paper_tables", false);
  result.is_ablation = json.value("is_ablation", false);
  return result;
}

}  // namespace

std::vector<MethodCase> parse_method_cases(std::string_view text) {
  std::vector<MethodCase> cases;
  try {
    const Json json = Json::parse(text);
    for (const Json& entry : json.at("cases")) cases.push_back(parse_case(entry));
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("methods: case {}: {}", cases.size(), error.what()));
  }
  return cases;
}

const std::vector<MethodCase>& all_method_cases() {
  static const std::vector<MethodCase> cases = parse_method_cases(embedded::methods_json());
  return cases;
}

std::vector<std::string> all_compared_methods() {
  std::vector<std::string> names = {std::string(kInitial)};
  for (const MethodCase& method_case : all_method_cases())
    if (!method_case.is_ablation) names.push_back(method_case.name);
  return names;
}

nlohmann::ordered_json to_json(const MethodCase& method_case) {
  return {{"name", method_case.name},
          {"title", method_case.title},
          {"method", method_case.method},
          {"options", method_case.options},
          {"vertices_of", method_case.vertices_of},
          {"cavities", method_case.cavities},
          {"is_timed", method_case.is_timed},
          {"is_in_paper_tables", method_case.is_in_paper_tables},
          {"is_ablation", method_case.is_ablation}};
}

MethodCase find_method_case(std::string_view name) {
  const std::vector<MethodCase>& cases = all_method_cases();
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const MethodCase& c) { return c.name == name; });
  if (found != cases.end()) return *found;
  MethodCase unlisted;
  unlisted.name = unlisted.title = unlisted.method = name;
  return unlisted;
}

}  // namespace smopt::experiments
