#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "smopt/progress.h"

namespace smopt {

struct ProcessLimits {
  double seconds = 0;         ///< wall time, positive; the process and all it started are killed then
  std::size_t memory_mb = 0;  ///< address space (RLIMIT_AS); 0: no limit. Under AddressSanitizer there is none: it reserves terabytes
  double grace_seconds = 0;   ///< between asking what is still there to end (SIGTERM) and killing it: for a program that must tidy up
};

/// Where a process runs.
struct ProcessSurroundings {
  std::map<std::string, std::string> environment;  ///< variables set besides those of this process
  std::filesystem::path folder;                    ///< its working directory; empty: that of this process
};

/// How a process ended.
struct ProcessOutcome {
  std::optional<int> exit_status;  ///< of a process that ended by itself
  std::optional<int> signal;       ///< that ended it
  bool out_of_time = false;
  double seconds = 0;         ///< wall time
  double cpu_seconds = 0;     ///< of all processors, by the program and by those of its children that it waited for
  double peak_memory_mb = 0;  ///< resident, of the program alone, as seen the last time it was looked at (each 50 ms)
  std::string output;         ///< the last part of standard output and standard error, mixed
};

/// Runs a program and waits for it. It reads nothing, leaves no core dump, and dies with the thread that called. Whatever it started and
/// left behind is ended with it, unless that made itself a process group of its own.
/// \param command  the program's file and its arguments.
/// \param progress  called about twenty times a second with `stage` and the fraction of the time limit; when it cancels, the process is
/// killed. \throws InvalidInput when the program cannot be started; Cancelled.
ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits, const char* stage,
                           const ProgressCallback& progress, const ProcessSurroundings& surroundings = {});

}  // namespace smopt
