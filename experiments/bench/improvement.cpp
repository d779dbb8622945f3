#include <benchmark/benchmark.h>

#include <string>

#include "experiments/bench/bench_mesh.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/child_run.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"
#include "smopt/improve/improve.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/scratch_folder.h"
#include "smopt/timing.h"

namespace smopt::bench {
namespace {

void measure_improve(benchmark::State& state) {
  const ThreadLimit limit(state.range(0));
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).surface;
  for (auto _ : state) {
    TriangleMesh copy = mesh;
    const Stopwatch stopwatch;
    improve(copy, {});
    state.SetIterationTime(stopwatch.elapsed().wall);
  }
  state.counters["vertices"] = static_cast<double>(mesh.vertex_count());
}

/// `smopt improve IN -o OUT`, files included.
void measure_program(benchmark::State& state, const std::string& program) {
  const ScratchFolder folder("bench");
  const std::string input = (folder / "surface.off").string(), output = (folder / "improved.off").string();
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).surface;
  const auto vertices = static_cast<double>(mesh.vertex_count()), triangles = static_cast<double>(mesh.triangle_count());
  write_mesh(input, mesh);
  forget_bench_mesh();  // leaves the machine's memory to the program
  ChildRun run;
  for (auto _ : state) {
    run = run_child({program, "--quiet", "--threads", std::to_string(state.range(0)), "improve", input, "-o", output});
    state.SetIterationTime(run.seconds);
  }
  state.counters["vertices"] = vertices;
  state.counters["peak_megabytes"] = 1e-6 * run.peak_bytes;
  state.counters["bytes_per_triangle"] = run.peak_bytes / triangles;
}

}  // namespace

void register_improvement(const Sizes& sizes, const std::string& program) {
  with_threads(benchmark::RegisterBenchmark("improve", measure_improve), sizes);
  with_threads(benchmark::RegisterBenchmark("program", measure_program, program), sizes);
}

}  // namespace smopt::bench
