#pragma once

#include <filesystem>

#include "smopt/progress.h"

namespace smopt::experiments {

/// Writes `directory`/tables and `directory`/figures from the records of a run, and from nothing else.
/// \throws InvalidInput when there are no records or one cannot be read; or, once the tables are written, when matplotlib is missing.
void write_report(const std::filesystem::path& directory, const ProgressCallback& progress = {});

}  // namespace smopt::experiments
