#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/ablation/figure_data.h"
#include "experiments/runner.h"

namespace smopt::experiments {

/// What `smopt ablate` was asked to do.
struct AblateOptions {
  std::filesystem::path directory = "results/ablation";  ///< where records, tables, figures and the page go
  std::vector<std::string> molecules;                    ///< names of datasets; empty: those of ablation.json
  std::filesystem::path data;                            ///< a folder of the user's molecules and meshes; empty: none
  std::string design = "all";                            ///< see `chosen_designs`
  bool is_quick = false;                                 ///< the quick designs of ablation.json, one repeat
  RunOptions run;                                        ///< how it is run; what the others say is filled in
};

/// "one-at-a-time", "factorial", "thresholds" or "all". \throws InvalidOption for anything else.
ChosenDesigns chosen_designs(std::string_view design);

/// Runs the ablation study: every case of the designs on every molecule, each once, however many designs ask for it; then its tables, figures and
/// page.
/// \throws InvalidOption for an unknown name; InvalidInput when something cannot be written or Python's matplotlib is missing (records, tables and
/// page are there then); Cancelled. A case that fails is no exception: the summary and the page tell it.
RunSummary ablate(const AblateOptions& options, const RunObserver& observer = {});

/// Writes `directory`/tables, ablation.json, README.md and figures from `directory`/records.
void write_ablation(const AblationPlan& plan, const RecordSet& records, const ChosenDesigns& designs,
                    const std::filesystem::path& directory, const ProgressCallback& progress = {});

}  // namespace smopt::experiments
