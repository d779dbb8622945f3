#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/figures/figures.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// What a report is of, and what it lacks.
struct ReportOutcome {
  std::size_t cases = 0;                   ///< the records that it was written from
  std::optional<std::string> why_no_page;  ///< where report.html was not written; nothing when it was
  std::vector<std::string> figure_notes;   ///< a line for each figure that was left out: why, and what brings it
};

/// Writes `directory`/tables, `directory`/report.html and `directory`/figures from the records of a run, and from nothing else; the page shows
/// the run's meshes where it still has them.
/// \throws InvalidInput when there are no records or one cannot be read; or, once the tables and the page are written, when matplotlib is missing.
ReportOutcome write_report(const std::filesystem::path& directory, const ProgressCallback& progress = {},
                           const FigureOptions& figures = {});

}  // namespace smopt::experiments
