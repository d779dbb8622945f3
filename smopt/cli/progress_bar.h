#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "smopt/cli/interrupt.h"
#include "smopt/progress.h"

namespace smopt::cli {

/// A bar with the time left on standard error, for stages that take longer than a second ("experiments: smopt, measure" is the stage "experiments" and
/// what it does just now); nothing when that is not a terminal. Its callback
/// also makes the stage stop at Ctrl-C; until its first call Ctrl-C ends the program at once, as it may be waiting for input.
class ProgressBar {
 public:
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] ProgressCallback callback();

  /// Prints a line on standard output without tearing the bar.
  void print_line(std::string_view line);

 private:
  using Clock = std::chrono::steady_clock;

  void show(std::string_view stage, double fraction);
  void clear();

  std::optional<CancellableSection> cancellable_;
  bool is_shown_;
  bool has_line_ = false;
  std::string stage_;
  Clock::time_point stage_start_;
  Clock::time_point last_shown_;
};

}  // namespace smopt::cli
