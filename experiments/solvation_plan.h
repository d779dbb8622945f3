#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "experiments/datasets.h"

namespace smopt::experiments {

/// Which solvation energies a run computes.
struct SolvationSettings {
  std::uint64_t max_memory_bytes = std::uint64_t{12} << 30;  ///< of one solve; more is not tried. A million vertices take less than 10 GB
  bool is_quick = false;                                     ///< of the molecules for `--quick` only
};

/// Why a case's solvation energy is not computed, in words; empty where it is. It is for what Table 1 shows (the initial mesh and SMOPT's), of the
/// molecules that datasets.json names for it.
std::string why_no_solvation(const Dataset& dataset, std::string_view method, const SolvationSettings& settings);

}  // namespace smopt::experiments
