#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "experiments/datasets.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// Which solvation energies a run computes.
struct SolvationSettings {
  std::uint64_t max_memory_bytes = std::uint64_t{12} << 30;  ///< of one solve; more is not tried. A million vertices take less than 10 GB
  bool is_quick = false;                                     ///< of the molecules for `--quick` only
};

/// Whether a case's solvation energy is computed, and with how much memory.
struct SolvationPlan {
  std::string why_not;  ///< in words; empty: it is computed
  std::uint64_t max_memory_bytes = 0;
};

/// It is for what Table 1 shows (the initial mesh and SMOPT's), of the molecules that datasets.json names for it.
SolvationPlan solvation_plan(const Dataset& dataset, std::string_view method, const SolvationSettings& settings);

/// A record's `solvation`, whatever becomes of it: what `smopt solvate --json` prints with AFMPB's defaults, and the options; or the status
/// "not computed", "over limit" (more memory would be needed than the plan allows) or "failed", with the reason. On all threads. \throws Cancelled.
nlohmann::ordered_json solvation_of(const TriangleMesh& mesh, const Molecule& molecule, const SolvationPlan& plan,
                                    const ProgressCallback& progress);

}  // namespace smopt::experiments
