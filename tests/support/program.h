#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/files.h"

namespace smopt::testing {

/// How a program ended and what it printed.
struct ProgramResult {
  int exit_code = -1;  ///< -1 when it was ended by a signal
  int signal = 0;      ///< that ended it; SIGKILL when it ran out of time
  bool is_out_of_time = false;
  std::string out;
  std::string err;
};

/// Longest time a program may take before it is killed: far above what any test needs, also under sanitizers on a busy machine.
inline constexpr std::chrono::seconds kProgramTimeLimit{240};

/// A program that runs beside the test; killed, if it still runs, at the end of the scope.
class RunningProgram {
 public:
  /// What its standard input is.
  enum class Input { text, open_pipe };  ///< `open_pipe`: one that nothing is ever written to

  RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments, const std::string& input = {},
                 Input kind = Input::text);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  [[nodiscard]] bool is_running();
  /// Processor seconds it has used so far; 0 once it has ended.
  [[nodiscard]] double cpu_seconds() const;
  ProgramResult wait(std::chrono::milliseconds time_limit = kProgramTimeLimit);

 private:
  TemporaryFolder folder_;  ///< what it reads and prints, out of the way of the test's own files
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::optional<int> status_;
};

/// Runs a program to its end with `input` on its standard input.
ProgramResult run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments, const std::string& input = {});

}  // namespace smopt::testing
