#include "experiments/reproduce.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

std::vector<std::string> chosen_suites(const ReproduceOptions& options) {
  if (!options.suites.empty()) return options.suites;
  if (options.is_quick) return {std::string(kQuickSuite)};
  if (options.is_full) return {std::string(kPaperSuite)};
  return {std::string(kDefaultSuite)};
}

std::vector<Dataset> chosen_datasets(const ReproduceOptions& options) {
  const std::vector<Dataset> known = known_datasets(options.data);
  if (!options.molecules.empty()) return find_datasets(known, options.molecules);
  const bool adds_folder = options.suites.empty() && !options.is_quick && !options.is_full;
  const std::vector<std::string> suites = chosen_suites(options);
  std::vector<Dataset> chosen;
  for (const Dataset& dataset : known) {
    const bool is_in = std::ranges::any_of(suites, [&](const std::string& suite) { return dataset.is_in(suite); });
    if (is_in || (adds_folder && dataset.is_of_folder)) chosen.push_back(dataset);
  }
  return chosen;
}

std::vector<std::string> chosen_names(const ReproduceOptions& options) {
  return options.methods == std::vector<std::string>{"all"} ? all_compared_methods() : options.methods;
}

/// "smopt:guard=none".
void apply_override(std::vector<MethodCase>& cases, const std::string& text) {
  const std::size_t colon = text.rfind(':', text.find('=')), equals = text.find('=');
  if (colon == std::string::npos || equals == std::string::npos || colon > equals)
    throw InvalidOption(fmt::format("--override: expected METHOD:OPTION=VALUE, got '{}'", text));
  const auto found = std::ranges::find(cases, text.substr(0, colon), &MethodCase::name);
  if (found == cases.end()) throw InvalidOption(fmt::format("--override {}: no such method in this run", text));
  found->options[text.substr(colon + 1, equals - colon - 1)] = text.substr(equals + 1);
  found->title += fmt::format(" ({})", text.substr(colon + 1));  // tables and figures are not to pass it for the case as it is known
}

std::vector<MethodCase> chosen_cases(const ReproduceOptions& options) {
  std::vector<MethodCase> cases;
  for (const std::string& name : chosen_names(options))
    if (std::ranges::find(cases, name, &MethodCase::name) == cases.end()) cases.push_back(find_method_case(name));
  for (const std::string& text : options.overrides) apply_override(cases, text);
  return cases;
}

}  // namespace

RunOptions run_options(const ReproduceOptions& options) {
  RunOptions run = options.run;
  run.datasets = chosen_datasets(options);
  run.cases = chosen_cases(options);
  run.directory = options.directory;
  run.solvation.is_quick = options.is_quick;
  if (options.is_quick) run.repeats = 1;
  return run;
}

std::vector<std::string> left_out_of_folder(const ReproduceOptions& options) {
  const std::vector<Dataset> chosen = chosen_datasets(options);
  std::vector<std::string> names;
  for (const Dataset& dataset : known_datasets(options.data))
    if (dataset.is_of_folder && dataset.suites.empty() && std::ranges::find(chosen, dataset.name, &Dataset::name) == chosen.end())
      names.push_back(dataset.name);
  return names;
}

ReproduceSummary reproduce(const ReproduceOptions& options, const RunObserver& observer) {
  const RunOptions run = run_options(options);
  if (options.is_plan_only) {
    write_plan(run);
    return {};
  }
  ReproduceSummary summary{run_cases(run, observer), {}};
  summary.report = write_report(options.directory, observer.progress);
  return summary;
}

}  // namespace smopt::experiments
