#pragma once

#include <string>
#include <vector>

namespace smopt::bench {

/// What a program took.
struct ChildRun {
  double seconds = 0;     ///< wall, from its start to its end
  double peak_bytes = 0;  ///< largest resident memory
};

/// Runs a program to its end; `arguments[0]` is its path.
///
/// The peak is read from /proc while the program runs (and may miss what it allocates in its last milliseconds): the system's own account
/// at its end (`ru_maxrss`) counts the memory of the process that started it too. \throws std::runtime_error when it cannot be started or
/// ends with another exit code than 0.
ChildRun run_child(const std::vector<std::string>& arguments);

}  // namespace smopt::bench
