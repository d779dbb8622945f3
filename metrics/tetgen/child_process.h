#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "smopt/progress.h"

namespace smopt::metrics {

struct ProcessLimits {
  double seconds = 0;         ///< wall time, positive; the process and all it started are killed then
  std::size_t memory_mb = 0;  ///< address space (RLIMIT_AS); 0: no limit. Under AddressSanitizer there is none: it reserves terabytes
};

/// How a process ended.
struct ProcessOutcome {
  std::optional<int> exit_status;  ///< of a process that ended by itself
  std::optional<int> signal;       ///< that ended it
  bool out_of_time = false;
  double seconds = 0;         ///< wall time
  double peak_memory_mb = 0;  ///< resident, of the program alone, as seen the last time it was looked at (each 50 ms)
  std::string output;         ///< the last part of standard output and standard error, mixed
};

/// Runs a program and waits for it. It reads nothing, leaves no core dump, and dies with the thread that called.
/// \param progress  called about twenty times a second with `stage` and the fraction of the time limit; when it cancels, the process is
/// killed. \throws InvalidInput when the program cannot be started; Cancelled.
ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits, const char* stage,
                           const ProgressCallback& progress);

}  // namespace smopt::metrics
