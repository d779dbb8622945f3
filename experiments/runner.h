#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "experiments/solvation_run.h"
#include "smopt/improve/method.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// The cases of a run, and how they are run.
struct RunOptions {
  std::vector<Dataset> datasets;
  std::vector<std::string> methods;  ///< kInitial, names of methods.json or of the registry
  std::filesystem::path directory;   ///< records go to `directory`/records/<molecule>/<method>.json
  int repeats = 1;                   ///< of everything that is timed; ≥ 1
  bool keeps_meshes = false;         ///< write `directory`/meshes/<molecule>/<method>.off
  SolvationSettings solvation;
};

/// Who is told how a run goes.
struct RunObserver {
  ProgressCallback progress;                        ///< the fraction of the whole run; returning false cancels
  std::function<void(std::string_view line)> line;  ///< one line of text as each case ends
};

enum class CaseStatus { done, failed, not_installed };

/// One case: what became of it.
struct CaseOutcome {
  std::string molecule;
  std::string method;
  CaseStatus status = CaseStatus::failed;
  std::string reason;  ///< why it is not done; empty when it is
};

struct RunSummary {
  std::vector<CaseOutcome> cases;  ///< in the order in which they ran
  double seconds = 0;              ///< wall time

  [[nodiscard]] std::size_t count(CaseStatus status) const;
};

/// Runs every case (molecule × method) and writes its record as soon as it ends.
///
/// A molecule's surface is generated and prepared once; every method gets the same mesh, without its cavities. A case that asks for the
/// vertices of another's result gets their number, for which the other is run if it has not been. What a case throws is the
/// reason in its record, and the others go on. \throws InvalidOption for a method that the registry does not have; InvalidInput when a
/// record cannot be written; Cancelled.
RunSummary run_cases(const RunOptions& options, const MethodRegistry& registry, const RunObserver& observer = {});

}  // namespace smopt::experiments
