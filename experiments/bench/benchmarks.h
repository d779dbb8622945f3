#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace smopt::bench {

/// Numbers of copies of the molecule to measure with (see `bench_mesh`).
using Sizes = std::vector<std::int64_t>;

/// Adds benchmarks to Google Benchmark's list: `<what>/threads:<n>/copies:<n>`, or without the threads where there is only one.
/// Each measures wall time; meshes are made, copied and freed outside of what is measured.
void register_smoothing(const Sizes& sizes);  ///< the floor, and smoothing with the default options beside it
void register_baselines(const Sizes& sizes);  ///< the other methods
void register_stages(const Sizes& sizes);     ///< validity, cavities, redundant points
void register_files(const Sizes& sizes);      ///< OFF text
void register_solvation(const Sizes& sizes);  ///< the Poisson–Boltzmann solver, at spacings of its own: `solvation/threads:2/spacing_mA:<n>`
/// The whole of it, within this process and as the program of this path.
void register_improvement(const Sizes& sizes, const std::string& program);

}  // namespace smopt::bench
