#include "experiments/report.h"

#include "experiments/page/page.h"
#include "experiments/record_set.h"
#include "experiments/tables/write_tables.h"

namespace smopt::experiments {

ReportOutcome write_report(const std::filesystem::path& directory, const ProgressCallback& progress, const FigureOptions& figures) {
  const RecordSet records = RecordSet::load(directory);
  write_tables(records, directory / "tables");
  ReportOutcome outcome{records.size(), write_page(records, directory, progress), {}};
  outcome.figure_notes = draw_figures(records, directory, progress, figures);
  return outcome;
}

}  // namespace smopt::experiments
