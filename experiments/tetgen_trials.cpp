#include "experiments/tetgen_trials.h"

#include "experiments/method_cases.h"
#include "metrics/tetgen/tetrahedralize.h"

namespace smopt::experiments {
namespace {

constexpr double kQualityTimeLimitSeconds = 300;

}  // namespace

std::vector<TetgenTrial> tetgen_trials(std::string_view method) {
  const double usual_limit = metrics::TetrahedralizeOptions().time_limit_seconds;
  std::vector<TetgenTrial> trials = {{"p", usual_limit}, {"pY", usual_limit}};
  if (method == kSmopt || method == kSmopt2) trials.push_back({kQualitySwitches, kQualityTimeLimitSeconds});
  return trials;
}

}  // namespace smopt::experiments
