#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/datasets.h"
#include "smopt/improve/method.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// The pseudo-method: the mesh as it was generated.
inline constexpr std::string_view kInitial = "initial";

/// The cases of a run, and how they are run.
struct RunOptions {
  std::vector<Dataset> datasets;
  std::vector<std::string> methods;  ///< kInitial, or names of the registry
  std::filesystem::path directory;   ///< records go to `directory`/records/<molecule>/<method>.json
  int repeats = 1;                   ///< of everything that is timed; ≥ 1
  bool keeps_meshes = false;         ///< write `directory`/meshes/<molecule>/<method>.off
};

/// Who is told how a run goes.
struct RunObserver {
  ProgressCallback progress;                        ///< the fraction of the whole run; returning false cancels
  std::function<void(std::string_view line)> line;  ///< one line of text as each case ends
};

/// One case: what became of it.
struct CaseOutcome {
  std::string molecule;
  std::string method;
  bool is_done = false;
  std::string reason;  ///< why it failed; empty when done
};

struct RunSummary {
  std::vector<CaseOutcome> cases;  ///< in the order in which they ran
  double seconds = 0;              ///< wall time

  [[nodiscard]] std::size_t failures() const;
};

/// Runs every case (molecule × method) and writes its record as soon as it ends.
///
/// A molecule's surface is generated and prepared once; every method gets the same mesh, without its cavities. What a case throws is the
/// reason in its record, and the others go on. \throws InvalidOption for a method that the registry does not have; InvalidInput when a
/// record cannot be written; Cancelled.
RunSummary run_cases(const RunOptions& options, const MethodRegistry& registry, const RunObserver& observer = {});

}  // namespace smopt::experiments
