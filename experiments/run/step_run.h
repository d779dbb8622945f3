#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "experiments/run/step.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// Where steps run, and by which program.
struct StepPlace {
  std::filesystem::path directory;  ///< the run's
  std::filesystem::path program;    ///< what kThisProgram stands for
  std::string program_sha256;       ///< of that file: another program's results are not taken for this one's
  std::string tetgen_sha256;        ///< of the worker that runs TetGen, a program of its own; empty where there is none
  int threads = 0;                  ///< that a step which could use all may use; 0: all
};

/// \param program  empty: the program that runs this. \throws InvalidInput when there is none.
StepPlace step_place(const std::filesystem::path& directory, const std::filesystem::path& program);

/// What became of a step.
struct StepOutcome {
  std::string status;  ///< "done", "failed" or "not installed"
  std::string reason;  ///< in words; empty when it is done
  bool was_done_before = false;
  bool is_interrupted = false;  ///< somebody asked it to end, which says nothing of the step
};

/// What a step is made from: sha256 of the program, the command and the inputs' contents. \throws InvalidInput when an input is missing.
std::string step_key(const Step& step, const StepPlace& place);

/// Runs the command in a process of its own and writes the stamp: `key`, `status`, `reason`, `command`, the `sha256` of the outputs, how it ended,
/// `seconds`, `cpu_seconds`, `peak_memory_mb`, and the `machine`. A command that fails, crashes, or runs out of time or memory is an outcome with its
/// reason; so is a step whose predecessors did not end well. A stamp is there only when all is done: whoever is killed leaves none, and that of a command
/// that was asked to end (SIGTERM, SIGINT) has no `key`, so that it is done again.
/// \throws Cancelled; InvalidInput when nothing can be written.
StepOutcome run_step(const Step& step, const StepPlace& place, const ProgressCallback& progress);

/// What became of a step that was run with the same program, command and inputs, provided that its outputs are as it left them.
std::optional<StepOutcome> earlier_outcome(const Step& step, const StepPlace& place);

/// The stamp of a step; nothing when there is none.
std::optional<nlohmann::ordered_json> read_stamp(const Step& step, const std::filesystem::path& directory);

}  // namespace smopt::experiments
