#include <benchmark/benchmark.h>

#include "experiments/bench/bench_mesh.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"
#include "smopt/improve/prepare.h"
#include "smopt/improve/redundant_points.h"
#include "smopt/timing.h"

namespace smopt::bench {
namespace {

/// What comes before smoothing, on the surface as generated: the sum, and each stage as a counter (s).
void measure_stages(benchmark::State& state) {
  const ThreadLimit limit(state.range(0));
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).surface;
  StageTimes times;
  for (auto _ : state) {
    TriangleMesh copy = mesh;
    const Stopwatch stopwatch;
    times = prepare(copy, CavityPolicy::delete_cavities).seconds;
    timed(times, "redundant", [&] { remove_redundant_points(copy, {}); });
    state.SetIterationTime(stopwatch.elapsed().wall);
  }
  state.counters["vertices"] = static_cast<double>(mesh.vertex_count());
  for (const auto& [stage, seconds] : times) state.counters[stage] = seconds.wall;
}

}  // namespace

void register_stages(const Sizes& sizes) {
  with_threads(benchmark::RegisterBenchmark("stages", measure_stages), sizes);
}

}  // namespace smopt::bench
