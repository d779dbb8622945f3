#include "experiments/bench/child_run.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "smopt/peak_memory.h"
#include "smopt/timing.h"

namespace smopt::bench {
namespace {

/// Between two looks at the program: short beside the shortest run (0.2 s), long beside what a look costs (20 µs).
constexpr std::chrono::milliseconds kLookEvery{1};

constexpr double kBytesPerMb = 1 << 20;

pid_t start(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  pid_t pid = -1;
  if (posix_spawn(&pid, arguments[0].c_str(), nullptr, nullptr, pointers.data(), environ) != 0)
    throw std::runtime_error(fmt::format("{} cannot be started", arguments[0]));
  return pid;
}

}  // namespace

ChildRun run_child(const std::vector<std::string>& arguments) {
  ChildRun run;
  const Stopwatch stopwatch;
  const pid_t pid = start(arguments);
  int status = 0;
  while (waitpid(pid, &status, WNOHANG) == 0) {
    run.peak_bytes = std::max(run.peak_bytes, kBytesPerMb * peak_memory_mb_of(std::to_string(pid)));
    std::this_thread::sleep_for(kLookEvery);
  }
  run.seconds = stopwatch.elapsed().wall;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(fmt::format("{} failed", fmt::join(arguments, " ")));
  return run;
}

}  // namespace smopt::bench
