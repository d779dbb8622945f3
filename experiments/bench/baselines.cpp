#include "baselines/baselines.h"

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>

#include "experiments/bench/bench_mesh.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"

namespace smopt::bench {
namespace {

/// A method as it is measured: with these options.
struct MeasuredMethod {
  const char* title;
  const char* name;
  std::map<std::string, std::string> options;
};

/// A hundred rounds of every smoother that keeps the connectivity; GAMer 2 at its own six.
const MeasuredMethod kMethods[] = {
    {"laplacian", "laplacian", {{"rounds", "100"}}},
    {"laplacian_gauss_seidel", "laplacian", {{"rounds", "100"}, {"order", "gauss-seidel"}}},
    {"taubin", "taubin", {{"rounds", "100"}}},
    {"hc", "hc", {{"rounds", "100"}}},
    {"cotangent", "cotangent", {{"rounds", "100"}}},
    {"meshlab_uniform", "meshlab", {{"rounds", "100"}, {"weights", "uniform"}}},
    {"meshlab_cotangent", "meshlab", {{"rounds", "100"}, {"weights", "cotangent"}}},
    {"gamer", "gamer", {}},
};

void measure_method(benchmark::State& state, const MeasuredMethod& measured) {
  const ThreadLimit limit(state.range(0));
  const TriangleMesh& mesh = bench_mesh(static_cast<int>(state.range(1))).prepared;
  const Method& method = baselines::all_methods().find(measured.name);
  MethodReport report;
  double seconds = 0;
  for (auto _ : state) {
    TriangleMesh copy = mesh;
    report = method.run(copy, OptionValues(method.options, measured.options), {});
    seconds = report.seconds.back().second.wall;
    state.SetIterationTime(seconds);
  }
  const auto vertices = static_cast<double>(mesh.vertex_count());
  state.counters["vertices"] = vertices;
  state.counters["ns_per_move"] = 1e9 * seconds / (vertices * static_cast<double>(report.rounds_run));
}

}  // namespace

void register_baselines(const Sizes& sizes) {
  for (const MeasuredMethod& measured : kMethods)
    with_threads(benchmark::RegisterBenchmark((std::string("baseline_") + measured.title).c_str(), measure_method, measured), sizes);
}

}  // namespace smopt::bench
