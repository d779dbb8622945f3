#include "experiments/remesh_study/case_run.h"

#include <oneapi/tbb/task_arena.h>

#include "experiments/improve_run.h"
#include "experiments/machine.h"
#include "experiments/run_report.h"
#include "metrics/measure.h"
#include "metrics/measurement_json.h"
#include "smopt/error.h"
#include "smopt/improve/prepare.h"
#include "smopt/io/off.h"
#include "smopt/io/sha256.h"
#include "smopt/peak_memory.h"

namespace smopt::experiments {
namespace {

/// Table 2 counts seconds on one processor, as the paper's does.
constexpr int kTimedThreads = 1;

/// One run of a method, from the initial mesh to the improved one.
struct MethodRun {
  TriangleMesh mesh;
  PreparationReport preparation;
  MethodReport report;
  StageTimes times;
};

MethodRun run_once(const Method& method, const OptionValues& options, const TriangleMesh& initial, const ProgressCallback& progress) {
  MethodRun run;
  run.mesh = initial;
  const Stopwatch total;
  run.preparation = prepare(run.mesh, CavityPolicy::delete_cavities);
  run.report = method.run(run.mesh, options, progress);
  run.times = run.preparation.seconds;
  run.times.insert(run.times.end(), run.report.seconds.begin(), run.report.seconds.end());
  run.times.emplace_back("total", total.elapsed());
  return run;
}

Json mesh_json(const JudgedMesh& judged) {
  return {{"vertices", judged.mesh.vertex_count()},
          {"triangles", judged.mesh.triangle_count()},
          {"euler_characteristic", judged.metrics.at("euler_characteristic")},
          {"sha256", judged.sha256}};
}

void add_meshes(Json& record, const JudgedMesh& before, const JudgedMesh& after) {
  record["input"] = mesh_json(before);
  record["output"] = mesh_json(after);
  record["metrics"] = {{"before", before.metrics}, {"after", after.metrics}};
}

}  // namespace

JudgedMesh judge(TriangleMesh mesh) {
  JudgedMesh judged{std::move(mesh), {}, {}};
  judged.metrics = metrics::to_json(metrics::measure(judged.mesh));
  judged.sha256 = sha256_hex(format_off(judged.mesh, {}));
  return judged;
}

JudgedMesh prepare_input(const TriangleMesh& initial) {
  TriangleMesh mesh = initial;
  prepare(mesh, CavityPolicy::delete_cavities);
  return judge(std::move(mesh));
}

void record_outcome(Json& record, const std::function<void()>& fill) {
  try {
    fill();
    mark_done(record);
  } catch (const Cancelled&) {
    throw;
  } catch (const NotInstalled& error) {
    mark_not_installed(record, error.what());
  } catch (const std::bad_alloc&) {
    mark_failed(record, "out of memory");
  } catch (const std::exception& error) {
    mark_failed(record, error.what());
  }
}

TriangleMesh run_method_case(Json& record, const Method& method, const OptionValues& options, const TriangleMesh& initial,
                             const JudgedMesh& input, int repeats, const ProgressCallback& progress) {
  record["options"] = options_json(method, options);
  record["options"]["cavities"] = to_string(CavityPolicy::delete_cavities);
  record["threads"] = kTimedThreads;
  tbb::task_arena one_thread(kTimedThreads);
  std::vector<StageTimes> times;
  MethodRun run;
  reset_peak_memory();
  for (int i = 0; i < repeats; ++i) {
    run = one_thread.execute([&] { return run_once(method, options, initial, progress); });
    times.push_back(run.times);
  }
  add_repeats(record, times);
  add_medians(record);
  record["peak_memory_mb"] = peak_memory_mb();
  add_outcome(record, run.preparation, run.report);
  JudgedMesh output = judge(std::move(run.mesh));
  add_meshes(record, input, output);
  return std::move(output.mesh);
}

}  // namespace smopt::experiments
