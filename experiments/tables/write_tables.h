#pragma once

#include <filesystem>

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Writes the table to `folder` as .md, .csv and .tex. \throws InvalidInput when one cannot be written.
void write_table(const Table& table, const std::filesystem::path& folder);

/// Writes table1, table2 and table3 to `folder`, each as .md, .csv and .tex. \throws InvalidInput when one cannot be written.
void write_tables(const RecordSet& records, const std::filesystem::path& folder);

}  // namespace smopt::experiments
