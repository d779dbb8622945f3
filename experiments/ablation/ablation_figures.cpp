#include "experiments/ablation/ablation_figures.h"

#include "experiments/ablation/embedded.h"
#include "experiments/figures/python.h"

namespace smopt::experiments {
namespace {

/// Four figures take seconds; much longer is a Python that hangs.
constexpr double kTimeLimitSeconds = 600;

}  // namespace

void draw_ablation_figures(const std::filesystem::path& directory, const ProgressCallback& progress) {
  run_python({"-c", std::string(embedded::plot_ablation_program()), directory.string()}, kTimeLimitSeconds, progress);
}

}  // namespace smopt::experiments
