#include "experiments/report.h"

#include "experiments/figures/figures.h"
#include "experiments/record_set.h"
#include "experiments/tables/write_tables.h"

namespace smopt::experiments {

void write_report(const std::filesystem::path& directory, const ProgressCallback& progress) {
  const RecordSet records = RecordSet::load(directory);
  write_tables(records, directory / "tables");
  draw_figures(records, directory, progress);
}

}  // namespace smopt::experiments
