#include "smopt/improve/smoothing.h"

#include <benchmark/benchmark.h>

#include "experiments/bench/bench_mesh.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/floor_laplacian.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"
#include "smopt/timing.h"

namespace smopt::bench {
namespace {

constexpr int kRounds = 100;

Seconds seconds_of_floor(FloorLaplacian& floor, const TriangleMesh& mesh, FloorLaplacian::Loop loop) {
  floor.reset(mesh);
  const Stopwatch stopwatch;
  floor.run(kRounds, loop);
  benchmark::DoNotOptimize(floor.points().data());
  return stopwatch.elapsed();
}

void measure_floor(benchmark::State& state, FloorLaplacian::Loop loop) {
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(0))).prepared;
  FloorLaplacian floor(mesh);
  double seconds = 0;
  for (auto _ : state) {
    seconds = seconds_of_floor(floor, mesh, loop).wall;
    state.SetIterationTime(seconds);
  }
  const auto vertices = static_cast<double>(mesh.vertex_count());
  state.counters["vertices"] = vertices;
  state.counters["ns_per_move"] = 1e9 * seconds / (kRounds * vertices);
}

/// The floor is measured next to each run of smoothing, so that both see the machine in the same state. With one thread the ratios are of
/// processor time, which is wall time on a quiet machine and nearly the same on a busy one.
void measure_smoothing(benchmark::State& state) {
  const ThreadLimit limit(state.range(0));
  const auto relevant = [&](const Seconds& seconds) { return state.range(0) == 1 ? seconds.cpu : seconds.wall; };
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).prepared;
  FloorLaplacian floor(mesh);
  Seconds fastest, straightforward, smoothing;
  SmoothingReport report;
  for (auto _ : state) {
    fastest = seconds_of_floor(floor, mesh, FloorLaplacian::Loop::branchless);
    straightforward = seconds_of_floor(floor, mesh, FloorLaplacian::Loop::straightforward);
    TriangleMesh copy = mesh;
    const Stopwatch stopwatch;
    report = smooth(copy, {});
    smoothing = stopwatch.elapsed();
    state.SetIterationTime(smoothing.wall);
  }
  const auto moves = static_cast<double>(report.moves.accepted);
  state.counters["vertices"] = static_cast<double>(mesh.vertex_count());
  state.counters["moves"] = moves;
  state.counters["ns_per_move"] = 1e9 * relevant(smoothing) / moves;
  state.counters["moves_per_second"] = moves / relevant(smoothing);
  state.counters["floor_seconds"] = relevant(fastest);
  state.counters["ratio_to_floor"] = relevant(smoothing) / relevant(fastest);
  state.counters["ratio_to_straightforward_loop"] = relevant(smoothing) / relevant(straightforward);
}

}  // namespace

void register_smoothing(const Sizes& sizes) {
  using Loop = FloorLaplacian::Loop;
  for (const auto& [name, loop] : {std::pair{"floor", Loop::branchless}, std::pair{"floor_straightforward", Loop::straightforward}})
    timed_once(benchmark::RegisterBenchmark(name, measure_floor, loop))->ArgName("copies")->ArgsProduct({sizes});
  with_threads(benchmark::RegisterBenchmark("smoothing", measure_smoothing), sizes);
}

}  // namespace smopt::bench
