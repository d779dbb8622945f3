#include "experiments/ablation/ablate.h"

#include <fmt/format.h>

#include "experiments/ablation/ablation_figures.h"
#include "experiments/ablation/ablation_page.h"
#include "experiments/ablation/ablation_tables.h"
#include "experiments/run_layout.h"
#include "experiments/tables/write_tables.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

/// Only those of this study: the folder may have records of others.
RecordSet load_records(const RunOptions& run) {
  const RecordSet all = RecordSet::load(run.directory);
  RecordSet records;
  for (const Dataset& dataset : run.datasets)
    for (const MethodCase& method_case : run.cases)
      if (const auto* const record = all.find(dataset.name, method_case.name); record != nullptr)
        records.add(*record, record_path(run.directory, dataset.name, method_case.name).string());
  return records;
}

/// Every case of the designs on every molecule; no simulation is asked for.
RunOptions run_options(const AblateOptions& options, const AblationPlan& plan, const ChosenDesigns& designs) {
  RunOptions run = options.run;
  run.datasets = find_datasets(known_datasets(options.data), options.molecules.empty() ? plan.molecules : options.molecules);
  for (const DesignCase& c : chosen_cases(plan, designs)) run.cases.push_back(c.method_case);
  run.directory = options.directory;
  run.simulates = false;
  if (options.is_quick) run.repeats = 1;
  return run;
}

std::vector<Table> tables_of(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs) {
  std::vector<Table> tables;
  if (designs.one_at_a_time) tables.push_back(one_at_a_time_table(plan, molecules));
  if (designs.factorial)
    for (const auto& make : {main_effects_table, interactions_table, factorial_table}) tables.push_back(make(plan, molecules));
  if (designs.thresholds) tables.push_back(thresholds_table(plan, molecules));
  return tables;
}

}  // namespace

ChosenDesigns chosen_designs(std::string_view design) {
  if (design == "all") return {};
  if (design == "one-at-a-time") return {true, false, false};
  if (design == "factorial") return {false, true, false};
  if (design == "thresholds") return {false, false, true};
  throw InvalidOption(fmt::format("--design: expected one-at-a-time, factorial, thresholds or all, got {}", design));
}

void write_ablation(const AblationPlan& plan, const RecordSet& records, const ChosenDesigns& designs,
                    const std::filesystem::path& directory, const ProgressCallback& progress) {
  const std::vector<Outcomes> molecules = outcomes_of(records);
  std::error_code ignored;  // if the folder cannot be made, writing says so
  std::filesystem::create_directories(directory / "tables", ignored);
  for (const Table& table : tables_of(plan, molecules, designs)) write_table(table, directory / "tables");
  write_file(directory / "ablation.json", figure_data(plan, molecules, designs).dump(1) + "\n");
  write_file(directory / "README.md", ablation_page(plan, molecules, designs));
  draw_ablation_figures(directory, progress);
}

RunSummary ablate(const AblateOptions& options, const RunObserver& observer) {
  const AblationPlan& plan = ablation_plan(options.is_quick);
  const ChosenDesigns designs = chosen_designs(options.design);
  const RunOptions run = run_options(options, plan, designs);
  RunSummary summary = run_cases(run, observer);
  write_ablation(plan, load_records(run), designs, options.directory, observer.progress);
  return summary;
}

}  // namespace smopt::experiments
