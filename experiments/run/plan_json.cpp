#include <fmt/format.h>

#include "experiments/run/run_plan.h"
#include "smopt/error.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const PlanOptions& options) {
  return {{"repeats", options.repeats},
          {"simulates", options.simulates},
          {"solvation_memory_bytes", options.solvation.max_memory_bytes},
          {"is_quick", options.solvation.is_quick},
          {"step_seconds", options.step_seconds},
          {"step_memory_mb", options.step_memory_mb}};
}

PlanOptions parse_options(const Json& json) {
  PlanOptions options;
  options.repeats = json.at("repeats").get<int>();
  options.simulates = json.at("simulates").get<bool>();
  options.solvation.max_memory_bytes = json.at("solvation_memory_bytes").get<std::uint64_t>();
  options.solvation.is_quick = json.at("is_quick").get<bool>();
  options.step_seconds = json.at("step_seconds").get<double>();
  options.step_memory_mb = json.at("step_memory_mb").get<std::size_t>();
  return options;
}

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

}  // namespace

Json to_json(const RunPlan& plan) {
  return {{"version", version()},
          {"options", options_json(plan.options)},
          {"molecules", list_of(plan.options.datasets)},
          {"cases", list_of(plan.options.cases)},
          {"steps", list_of(plan.steps)}};
}

RunPlan parse_plan(const std::string& text, const std::string& source) {
  try {
    const Json json = Json::parse(text);
    PlanOptions options = parse_options(json.at("options"));
    options.datasets = parse_datasets(text);
    options.cases = parse_method_cases(text);
    return make_plan(std::move(options));
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("{}: not a plan: {}", source, error.what()));
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace smopt::experiments
