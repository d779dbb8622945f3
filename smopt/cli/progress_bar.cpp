#include "smopt/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace smopt::cli {
namespace {

/// A stage shorter than this shows no bar.
constexpr std::chrono::seconds kPatience{1};
/// Between two pictures of the bar.
constexpr std::chrono::milliseconds kRefresh{100};
constexpr int kBarWidth = 30;

std::string time_left(double elapsed_s, double fraction) {
  const double left = elapsed_s * (1 - fraction) / fraction;
  return left < 60 ? fmt::format("{:.0f} s left", left)
                   : fmt::format("{:.0f} min {:02.0f} s left", std::floor(left / 60), std::fmod(left, 60));
}

}  // namespace

ProgressBar::ProgressBar(bool is_quiet) : is_shown_(!is_quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  clear();
}

ProgressCallback ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    if (!cancellable_) cancellable_.emplace();
    if (is_shown_) show(stage, fraction);
    return !is_interrupted();
  };
}

void ProgressBar::print_line(std::string_view line) {
  clear();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void ProgressBar::show(std::string_view stage, double fraction) {
  const Clock::time_point now = Clock::now();
  if (const std::string_view name = stage.substr(0, stage.find(':')); name != stage_) {
    stage_ = name;
    stage_start_ = now;
  }
  if (now - stage_start_ < kPatience || now - last_shown_ < kRefresh || fraction <= 0) return;
  last_shown_ = now;
  has_line_ = true;
  const int filled = static_cast<int>(kBarWidth * std::clamp(fraction, 0.0, 1.0));
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} % {}", stage, "", filled, "", kBarWidth - filled, 100 * fraction,
             time_left(elapsed, fraction));
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (has_line_) fmt::print(stderr, "\r\033[K");
  has_line_ = false;
}

}  // namespace smopt::cli
