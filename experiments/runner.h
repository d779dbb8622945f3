#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/run/run_plan.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// The cases of a run, and how they are run.
struct RunOptions : PlanOptions {
  std::filesystem::path directory;  ///< records go to `directory`/records/<molecule>/<method>.json
  bool keeps_meshes = false;        ///< write `directory`/meshes/<molecule>/<method>.off
  bool resumes = false;             ///< what was done in `directory` before, by the same program of the same files, is not done again
  bool retries = false;             ///< with `resumes`: but what failed is
  std::filesystem::path program;    ///< that does the steps; empty: the one that runs this
  int jobs = 0;                     ///< cores that steps share, each a thread's; 0: all there are
  std::uint64_t memory_bytes = 0;   ///< that steps together may take, by estimate; 0: two thirds of the machine's
};

/// Who is told how a run goes.
struct RunObserver {
  ProgressCallback progress;                        ///< what runs, and the fraction of the whole run; returning false cancels
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
  std::vector<CaseOutcome> cases;  ///< in the order of the plan
  std::size_t steps_run = 0;       ///< commands
  std::size_t steps_reused = 0;    ///< that an earlier run had done
  double seconds = 0;              ///< wall time

  [[nodiscard]] std::size_t count(CaseStatus status) const;
};

/// Runs every case (molecule × method) and writes its record as soon as its steps have ended.
///
/// Each step is a process of its own with limits on time and memory, so that a method that crashes, hangs or eats memory is a row with its reason and
/// the others go on. Steps run beside each other as cores and memory allow; what is timed runs alone. `directory`/plan.json has the steps, and
/// `directory`/steps what each left behind.
/// \throws InvalidOption for a method that the registry does not have; InvalidInput when a molecule's file is missing, nothing can be written, or
/// another run is at work in the folder; Cancelled.
RunSummary run_cases(const RunOptions& options, const RunObserver& observer = {});

/// One step of a plan that another program drives.
struct PlannedStep {
  std::filesystem::path plan_file;
  std::string id;
  std::filesystem::path program;  ///< as in RunOptions
  int threads = 0;                ///< that a step which could use all may use; 0: all
};

/// Does one step of a plan, or one record. \return its status. \throws as `run_cases`.
std::string run_planned_step(const PlannedStep& planned, const ProgressCallback& progress);

/// Writes `directory`/plan.json for other programs that run the steps. \return the plan.
RunPlan write_plan(const RunOptions& options);

}  // namespace smopt::experiments
