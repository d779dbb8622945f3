#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace smopt {

/// Time spent in a stage: on the wall, and by all processors of the process together.
struct Seconds {
  double wall = 0;
  double cpu = 0;
};

/// Runs from its construction.
class Stopwatch {
 public:
  Stopwatch() : wall_(Clock::now()), cpu_(cpu_now()) {}
  [[nodiscard]] Seconds elapsed() const { return {std::chrono::duration<double>(Clock::now() - wall_).count(), cpu_now() - cpu_}; }

 private:
  using Clock = std::chrono::steady_clock;
  static double cpu_now() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }

  Clock::time_point wall_;
  double cpu_;
};

/// Named stages in the order in which they ran.
using StageTimes = std::vector<std::pair<std::string, Seconds>>;

/// Runs `stage`, appends its time under `name`, and returns what it returns.
template <class Stage>
auto timed(StageTimes& times, std::string name, const Stage& stage) {
  const Stopwatch stopwatch;
  struct Append {
    StageTimes& times;
    std::string name;
    const Stopwatch& stopwatch;
    ~Append() { times.emplace_back(std::move(name), stopwatch.elapsed()); }
  } const append{times, std::move(name), stopwatch};
  return stage();
}

}  // namespace smopt
