#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "experiments/run/run_plan.h"

namespace smopt::experiments {

/// How much of a run is done, by the weights of its steps and the sizes of the molecules' files: what a step costs grows about as they do. Steps that
/// an earlier run did are not part of it.
class Workload {
 public:
  explicit Workload(const RunPlan& plan);

  void finish(std::size_t step, bool was_done_before);
  [[nodiscard]] double fraction() const { return total_ > reused_ ? (done_ - reused_) / (total_ - reused_) : 1; }
  /// Seconds; 0 before anything can be said.
  [[nodiscard]] double seconds_left() const;
  [[nodiscard]] double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<double> weights_;
  Clock::time_point start_ = Clock::now();
  double total_ = 0;
  double done_ = 0;
  double reused_ = 0;
};

/// "3 min 20 s".
std::string duration_text(double seconds);

}  // namespace smopt::experiments
