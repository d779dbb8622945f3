#pragma once

#include <benchmark/benchmark.h>

#include "experiments/bench/benchmarks.h"

namespace smopt::bench {

/// One run a repetition, timed by the benchmark itself, in seconds.
inline benchmark::internal::Benchmark* timed_once(benchmark::internal::Benchmark* benchmark) {
  return benchmark->Iterations(1)->UseManualTime()->Unit(benchmark::kSecond);
}

/// The same for each size, with one thread and with two.
inline benchmark::internal::Benchmark* with_threads(benchmark::internal::Benchmark* benchmark, const Sizes& sizes) {
  return timed_once(benchmark)->ArgNames({"threads", "copies"})->ArgsProduct({{1, 2}, sizes});
}

}  // namespace smopt::bench
