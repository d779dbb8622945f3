#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/report.h"
#include "experiments/runner.h"

namespace smopt::experiments {

/// What `smopt reproduce` was asked to do.
struct ReproduceOptions {
  std::filesystem::path directory = "results/run";  ///< where records, tables and figures go
  std::filesystem::path data;                       ///< a folder of the user's molecules and meshes, see `with_data_folder`; empty: none
  std::vector<std::string> molecules;               ///< names of datasets; empty: those of the suites
  std::vector<std::string> suites;                  ///< empty: the default one and what `data` has
  std::vector<std::string> methods = {"initial",   "smopt",    "smopt2",
                                      "laplacian", "iso2mesh", "meshlab"};  ///< cases; "all": all of methods.json but ablations
  std::vector<std::string> overrides;  ///< "smopt:guard=none": options of a case that are not those of methods.json
  bool is_quick = false;               ///< the suite of small molecules, one repeat, no solvation of larger ones
  bool is_full = false;                ///< the suite of the paper's six rows
  bool is_plan_only = false;           ///< write plan.json and run nothing
  RunOptions run;                      ///< all but what is said above: repeats, limits, resuming
};

struct ReproduceSummary : RunSummary {
  ReportOutcome report;

  /// Of earlier runs in the folder, which the tables and figures show as well.
  [[nodiscard]] std::size_t earlier_cases() const { return report.cases - cases.size(); }
};

/// The molecules, by name, suite and folder, and the cases, with what is overridden. \throws InvalidOption for an unknown name; InvalidInput for a
/// folder that cannot be read.
RunOptions run_options(const ReproduceOptions& options);

/// The molecules of the user's folder that are neither chosen nor known, by name: somebody may miss them. \throws as `run_options`.
std::vector<std::string> left_out_of_folder(const ReproduceOptions& options);

/// Runs the experiments over the datasets and writes `directory`/records, tables and figures.
/// \throws InvalidOption for an unknown name; InvalidInput when something cannot be written or Python's matplotlib is missing (the records
/// and tables are there then); Cancelled. A case that fails is no exception: the summary tells it.
ReproduceSummary reproduce(const ReproduceOptions& options, const RunObserver& observer = {});

}  // namespace smopt::experiments
