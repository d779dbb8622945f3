// smopt-bench: the speed and memory of the engine, by Google Benchmark.
//
//   smopt-bench --benchmark_out=bench.json && experiments/bench/table bench.json
//   smopt-bench --benchmark_filter=smoothing/threads:1/copies:1/
//   smopt-bench --tiny                               a small mesh only, to see that it works
//
// The sizes are 1, 15 and 60 copies of the AChE monomer: 65 thousand, 1 and 4 million vertices. The whole takes some minutes and about 3 GB.

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bench/benchmarks.h"
#include "experiments/machine.h"
#include "smopt/version.h"

namespace {

/// Ratios are medians of this many runs, unless the command line says otherwise.
constexpr const char* kRepetitions = "--benchmark_repetitions=3";

/// Removes the option from the arguments.
bool take_option(std::vector<char*>& arguments, std::string_view option) {
  return std::erase_if(arguments, [&](const char* argument) { return argument == option; }) > 0;
}

void add_context() {
  const auto machine = smopt::experiments::machine_json();
  benchmark::AddCustomContext("processor", machine["cpu"].is_string() ? machine["cpu"].get<std::string>() : "unknown");
  benchmark::AddCustomContext("compiler", smopt::experiments::compiler());
  benchmark::AddCustomContext("smopt_version", std::string(smopt::version()));
}

void register_all(const smopt::bench::Sizes& sizes) {
  smopt::bench::register_smoothing(sizes);
  smopt::bench::register_baselines(sizes);
  smopt::bench::register_stages(sizes);
  smopt::bench::register_files(sizes);
  smopt::bench::register_solvation(sizes);
  smopt::bench::register_improvement(sizes, SMOPT_PROGRAM);
}

int run(std::vector<char*> arguments) {
  const bool is_tiny = take_option(arguments, "--tiny");
  std::string repetitions = kRepetitions;
  arguments.insert(arguments.begin() + 1, repetitions.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  add_context();
  register_all(is_tiny ? smopt::bench::Sizes{0} : smopt::bench::Sizes{1, 15, 60});
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return run({argv, argv + argc}); } catch (const std::exception& error) {
  std::cerr << "smopt-bench: " << error.what() << '\n';
  return 1;
}
