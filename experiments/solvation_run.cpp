#include "experiments/solvation_run.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <new>

#include "experiments/method_cases.h"
#include "metrics/solvation/solvate.h"
#include "metrics/solvation/solvation_json.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kBytesPerMb = 1 << 20;

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

SolvationPlan solvation_plan(const Dataset& dataset, std::string_view method, const SolvationSettings& settings) {
  if (method != kInitial && method != kSmopt) return {"only for Table 1", 0};
  if (!dataset.has_solvation) return {"not for this molecule", 0};
  if (settings.is_quick && !dataset.is_in(kQuickSuite)) return {"not in a quick run", 0};
  return {"", settings.max_memory_bytes};
}

Json solvation_of(const TriangleMesh& mesh, const Molecule& molecule, const SolvationPlan& plan, const ProgressCallback& progress) {
  if (!plan.why_not.empty()) return without_energy("not computed", plan.why_not);
  metrics::SolvationOptions options;
  options.max_memory_bytes = plan.max_memory_bytes;
  options.progress = progress;
  try {
    const double needed = metrics::predicted_solvation_bytes(mesh, molecule, options);
    if (needed > static_cast<double>(plan.max_memory_bytes))
      return without_energy("over limit", fmt::format("needs {:.0f} MB", std::ceil(needed / kBytesPerMb)));
    return solved(mesh, molecule, options);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    return without_energy("failed", "out of memory");
  } catch (const std::exception& error) {
    return without_energy("failed", error.what());
  }
}

}  // namespace smopt::experiments
