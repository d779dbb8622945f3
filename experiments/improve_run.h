#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "smopt/improve/method.h"
#include "smopt/improve/prepare.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// One improvement of one mesh file.
struct ImproveRun {
  std::filesystem::path input;
  std::filesystem::path output;
  std::string method = "smopt";
  std::map<std::string, std::string> options;  ///< the method's, as given; defaults are filled in
  std::optional<CavityPolicy> cavities;        ///< empty: the method's default
  int digits = 0;                              ///< see MeshWriteOptions
  int repeats = 1;                             ///< of all but reading and writing, for the times; ≥ 1
  bool verify = false;                         ///< count intersecting pairs of the input and of the output as read back
};

struct ImproveRunResult {
  nlohmann::ordered_json report;            ///< what `improve --report` writes
  std::optional<std::size_t> pairs_before;  ///< with `verify`; empty without, and where `metrics::find_intersections` does not count
  std::optional<std::size_t> pairs_after;
};

/// Reads, prepares, improves and writes a mesh. Nothing is written when anything fails.
/// \throws InvalidInput (InvalidMesh) naming the input file; InvalidOption; Cancelled.
ImproveRunResult run_improvement(const ImproveRun& run, const ProgressCallback& progress = {});

/// `removed`, `rounds`, `moves`, `stopped_because`, … of the report and of a record.
void add_outcome(nlohmann::ordered_json& report, const PreparationReport& preparation, const MethodReport& outcome);

/// All options of a method with the defaults filled in, numbers as numbers.
nlohmann::ordered_json options_json(const Method& method, const OptionValues& values);

}  // namespace smopt::experiments
