#include "experiments/run/workload.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

namespace smopt::experiments {
namespace {

double size_of(const Dataset& dataset) {
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(dataset.path.empty() ? dataset.mesh : dataset.path, missing);
  return missing ? 1.0 : static_cast<double>(bytes) + 1.0;
}

}  // namespace

Workload::Workload(const RunPlan& plan) {
  std::map<std::string, double> sizes;
  for (const Dataset& dataset : plan.options.datasets) sizes[dataset.name] = size_of(dataset);
  for (const Step& step : plan.steps) {
    const bool repeats = step.needs.is_alone;
    weights_.push_back(step.needs.weight * sizes[step.molecule] * (repeats ? plan.options.repeats : 1));
    total_ += weights_.back();
  }
}

void Workload::finish(std::size_t step, bool was_done_before) {
  done_ += weights_[step];
  if (was_done_before) reused_ += weights_[step];
}

double Workload::seconds_left() const {
  const double worked = done_ - reused_;
  return worked > 0 ? seconds() * (total_ - done_) / worked : 0;
}

double Workload::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string duration_text(double seconds) {
  const long rounded = std::lround(seconds);
  if (rounded < 60) return fmt::format("{} s", rounded);
  if (rounded < 3600) return fmt::format("{} min {} s", rounded / 60, rounded % 60);
  return fmt::format("{} h {} min", rounded / 3600, rounded / 60 % 60);
}

}  // namespace smopt::experiments
