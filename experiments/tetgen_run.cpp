#include "experiments/tetgen_run.h"

#include "experiments/method_cases.h"
#include "metrics/tetgen/tetrahedralize.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kQualityTimeLimitSeconds = 300;

Json failed(const std::string& switches, std::string_view reason) {
  return {{"status", "failed"}, {"reason", reason}, {"switches", switches}};
}

Json outcome_of(const TriangleMesh& mesh, const TetgenTrial& trial, const ProgressCallback& progress) {
  metrics::TetrahedralizeOptions options;
  options.switches = trial.switches;
  options.time_limit_seconds = trial.time_limit_seconds;
  options.progress = progress;
  try {
    return metrics::to_json(metrics::tetrahedralize(mesh, options));
  } catch (const InvalidInput& error) {
    return failed(trial.switches, error.what());
  }
}

/// Whether the trial begins with what `p` alone does and `p` has failed.
bool is_hopeless(const TetgenTrial& trial, const Json& outcomes) {
  return trial.switches.starts_with("pq") && outcomes.contains("p") && outcomes.at("p").at("status") != "success";
}

}  // namespace

std::vector<TetgenTrial> tetgen_trials(std::string_view method) {
  const double usual_limit = metrics::TetrahedralizeOptions().time_limit_seconds;
  std::vector<TetgenTrial> trials = {{"p", usual_limit}, {"pY", usual_limit}};
  if (method == kSmopt || method == kSmopt2) trials.push_back({kQualitySwitches, kQualityTimeLimitSeconds});
  return trials;
}

Json tetgen_of(const TriangleMesh& mesh, const std::vector<TetgenTrial>& trials, const ProgressCallback& progress) {
  Json outcomes = Json::object();
  for (const TetgenTrial& trial : trials)
    outcomes[trial.switches] =
        is_hopeless(trial, outcomes) ? failed(trial.switches, "not tried: -p fails") : outcome_of(mesh, trial, progress);
  return outcomes;
}

}  // namespace smopt::experiments
