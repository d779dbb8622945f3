#include "experiments/remesh_study/simulations.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <new>

#include "metrics/solvation/solvate.h"
#include "metrics/solvation/solvation_json.h"
#include "metrics/tetgen/tetrahedralize.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kBytesPerMb = 1 << 20;

Json failed_trial(const std::string& switches, std::string_view reason) {
  return {{"status", "failed"}, {"reason", reason}, {"switches", switches}};
}

Json outcome_of(const TriangleMesh& mesh, const TetgenTrial& trial) {
  metrics::TetrahedralizeOptions options;
  options.switches = trial.switches;
  options.time_limit_seconds = trial.time_limit_seconds;
  try {
    return metrics::to_json(metrics::tetrahedralize(mesh, options));
  } catch (const InvalidInput& error) {
    return failed_trial(trial.switches, error.what());
  }
}

/// Whether the trial begins with what `p` alone does and `p` has failed.
bool is_hopeless(const TetgenTrial& trial, const Json& outcomes) {
  return trial.switches.starts_with("pq") && outcomes.contains("p") && outcomes.at("p").at("status") != "success";
}

Json without_energy(std::string_view status, std::string_view reason) {
  return {{"status", status}, {"reason", reason}};
}

Json solved(const TriangleMesh& mesh, const Molecule& molecule, const metrics::SolvationOptions& options) {
  Json json = metrics::to_json(metrics::solvate(mesh, molecule, options));
  json["options"] = metrics::to_json(options);
  json["threads"] = tbb::this_task_arena::max_concurrency();
  return json;
}

}  // namespace

Json tetgen_of(const TriangleMesh& mesh, const std::vector<TetgenTrial>& trials) {
  Json outcomes = Json::object();
  for (const TetgenTrial& trial : trials)
    outcomes[trial.switches] = is_hopeless(trial, outcomes) ? failed_trial(trial.switches, "not tried: -p fails") : outcome_of(mesh, trial);
  return outcomes;
}

Json solvation_of(const TriangleMesh& mesh, const Molecule& molecule, std::uint64_t max_memory_bytes) {
  metrics::SolvationOptions options;
  options.max_memory_bytes = max_memory_bytes;
  try {
    const double needed = metrics::predicted_solvation_bytes(mesh, molecule, options);
    if (needed > static_cast<double>(max_memory_bytes))
      return without_energy("over limit", fmt::format("needs {:.0f} MB", std::ceil(needed / kBytesPerMb)));
    return solved(mesh, molecule, options);
  } catch (const std::bad_alloc&) {
    return without_energy("failed", "out of memory");
  } catch (const std::exception& error) {
    return without_energy("failed", error.what());
  }
}

Json no_solvation(const std::string& why) {
  return without_energy("not computed", why);
}

}  // namespace smopt::experiments
