#include "experiments/reproduce.h"

#include "baselines/baselines.h"
#include "experiments/report.h"

namespace smopt::experiments {
namespace {

std::vector<Dataset> chosen_datasets(const ReproduceOptions& options) {
  if (!options.molecules.empty()) return find_datasets(all_datasets(), options.molecules);
  std::vector<Dataset> datasets = all_datasets();
  if (options.is_quick) std::erase_if(datasets, [](const Dataset& dataset) { return !dataset.is_quick; });
  return datasets;
}

std::vector<std::string> chosen_methods(const ReproduceOptions& options) {
  return options.methods == std::vector<std::string>{"all"} ? all_compared_methods() : options.methods;
}

}  // namespace

RunSummary reproduce(const ReproduceOptions& options, const RunObserver& observer) {
  RunOptions run;
  run.datasets = chosen_datasets(options);
  run.methods = chosen_methods(options);
  run.directory = options.directory;
  run.repeats = options.is_quick ? 1 : options.repeats;
  run.keeps_meshes = options.keeps_meshes;
  run.solvation = {options.solvation_memory_bytes, options.is_quick};
  RunSummary summary = run_cases(run, baselines::all_methods(), observer);
  write_report(options.directory, observer.progress);
  return summary;
}

}  // namespace smopt::experiments
