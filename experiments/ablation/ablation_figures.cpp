#include "experiments/ablation/ablation_figures.h"

#include <fmt/format.h>

#include <cstdlib>

#include "experiments/ablation/embedded.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"

namespace smopt::experiments {
namespace {

/// Four figures take seconds; much longer is a Python that hangs.
constexpr double kTimeLimitSeconds = 600;

std::string python() {
  const char* given = std::getenv("SMOPT_PYTHON");
  return given != nullptr && *given != '\0' ? given : "/usr/bin/python3";
}

}  // namespace

void draw_ablation_figures(const std::filesystem::path& directory, const ProgressCallback& progress) {
  const std::vector<std::string> command = {python(), "-c", std::string(embedded::plot_ablation_program()), directory.string()};
  if (!std::filesystem::exists(command.front()))
    throw InvalidInput(fmt::format("figures: {} does not exist (Debian package python3-matplotlib; or set SMOPT_PYTHON)", command.front()));
  const ProcessOutcome outcome = run_process(command, {kTimeLimitSeconds, 0}, "figures", progress);
  if (outcome.exit_status != 0) throw InvalidInput(fmt::format("figures: {} failed: {}", command.front(), outcome.output));
}

}  // namespace smopt::experiments
