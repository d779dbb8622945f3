#include <benchmark/benchmark.h>

#include "experiments/bench/bench_mesh.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/scratch_folder.h"
#include "smopt/timing.h"

namespace smopt::bench {
namespace {

/// Writing and reading OFF text: the sum, and each as a counter (s). The file is in the system's cache when it is read.
void measure_off(benchmark::State& state) {
  const ThreadLimit limit(state.range(0));
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).surface;
  const ScratchFolder folder("bench");
  const std::filesystem::path path = folder / "mesh.off";
  StageTimes times;
  for (auto _ : state) {
    times.clear();
    timed(times, "write", [&] { write_mesh(path, mesh); });
    const TriangleMesh copy = timed(times, "read", [&] { return read_mesh(path); });
    benchmark::DoNotOptimize(copy.points.data());
    state.SetIterationTime(times[0].second.wall + times[1].second.wall);
  }
  state.counters["vertices"] = static_cast<double>(mesh.vertex_count());
  state.counters["megabytes"] = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
  for (const auto& [what, seconds] : times) state.counters[what] = seconds.wall;
}

}  // namespace

void register_files(const Sizes& sizes) {
  with_threads(benchmark::RegisterBenchmark("off", measure_off), sizes);
}

}  // namespace smopt::bench
