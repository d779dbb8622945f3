#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/runner.h"

namespace smopt::experiments {

/// What `smopt reproduce` was asked to do.
struct ReproduceOptions {
  std::filesystem::path directory = "results/run";  ///< where records, tables and figures go
  std::vector<std::string> molecules;               ///< names of datasets; empty: all, with `is_quick` the small ones
  std::vector<std::string> methods = {"initial",   "smopt",    "smopt2",
                                      "laplacian", "iso2mesh", "meshlab"};      ///< as RunOptions; "all": all of methods.json but ablations
  bool is_quick = false;                                                        ///< small molecules only, one repeat
  int repeats = 3;                                                              ///< of everything that is timed; ≥ 1; 1 with `is_quick`
  bool keeps_meshes = false;                                                    ///< write each case's mesh to `directory`/meshes
  std::uint64_t solvation_memory_bytes = SolvationSettings().max_memory_bytes;  ///< a solve that needs more is a row that says so
};

/// Runs the experiments over the datasets and writes `directory`/records, tables and figures.
/// \throws InvalidOption for an unknown name; InvalidInput when something cannot be written or Python's matplotlib is missing (the records
/// and tables are there then); Cancelled. A case that fails is no exception: the summary tells it.
RunSummary reproduce(const ReproduceOptions& options, const RunObserver& observer = {});

}  // namespace smopt::experiments
