#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A run is a graph of steps. Each is a command of this program (or pdb2pqr) that makes files of files, and is identified by what it is made
/// from; tables and figures are made of what the steps leave behind.
namespace smopt::experiments {

/// More threads than any machine has.
inline constexpr int kAllThreads = 1 << 20;

/// How a step uses the machine.
struct StepNeeds {
  int threads = 1;              ///< that it uses; kAllThreads: all there are
  bool is_alone = false;        ///< nothing else may run meanwhile: its time is wanted
  double memory_base_mb = 0;    ///< with the next: about what it takes, which is for whoever places it
  double memory_per_input = 0;  ///< times the size of its input meshes
  double weight = 1;            ///< how long it takes for its molecule's size, beside other steps: for the time left
};

/// What ends a step by force.
struct StepLimits {
  double seconds = 0;         ///< wall time
  std::size_t memory_mb = 0;  ///< address space
};

/// One command of a run. File names are relative to the run's folder, in which it runs, or absolute.
struct Step {
  std::string id;    ///< "<molecule>/<case>.<rule>", with the switches of TetGen "<molecule>/<case>.tetrahedralize-p"
  std::string rule;  ///< "prepare", "generate", "improve", "measure", "tetrahedralize", "solvate" or "record"
  std::string molecule;
  std::string subject;               ///< the case (or "initial", "without-cavities", "molecule") that it is about
  std::vector<std::string> command;  ///< kThisProgram stands for the program's path. Empty for the rule "record", which is no command
  std::vector<std::string> inputs;   ///< files
  std::vector<std::string> outputs;  ///< files that are there when it has ended well
  std::vector<std::string> after;    ///< steps that make the inputs; it is tried only if they have ended well
  std::string hint;                  ///< how to get an input that is missing and that no step makes; empty: nobody knows
  bool may_say_no = false;           ///< exit code 1 is an answer, not a failure
  StepNeeds needs;
  StepLimits limits;
};

inline constexpr const char* kThisProgram = "smopt";

/// What says what became of a step: steps/<id>.step.json.
std::string stamp_path(const Step& step);

/// As in plan.json, for other programs that run steps: `rule`, `molecule`, `subject`, `command`, `inputs`, `outputs`, `after`, `stamp`, `threads`,
/// `memory_base_mb`, `memory_per_input`, `seconds`.
nlohmann::ordered_json to_json(const Step& step);

}  // namespace smopt::experiments
