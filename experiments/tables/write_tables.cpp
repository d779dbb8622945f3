#include "experiments/tables/write_tables.h"

#include "experiments/tables/csv.h"
#include "experiments/tables/latex.h"
#include "experiments/tables/markdown.h"
#include "experiments/tables/methods_table.h"
#include "experiments/tables/table1.h"
#include "experiments/tables/table2.h"
#include "experiments/tables/table3.h"
#include "smopt/io/file.h"

namespace smopt::experiments {

void write_table(const Table& table, const std::filesystem::path& folder) {
  write_file(folder / (table.name + ".md"), to_markdown(table));
  write_file(folder / (table.name + ".csv"), to_csv(table));
  write_file(folder / (table.name + ".tex"), to_latex(table));
}

void write_tables(const RecordSet& records, const std::filesystem::path& folder) {
  std::error_code ignored;  // if the folder cannot be made, writing says so
  std::filesystem::create_directories(folder, ignored);
  for (const Table& table : {table1(records), table2(records), table3(records), methods_table(records)}) write_table(table, folder);
}

}  // namespace smopt::experiments
