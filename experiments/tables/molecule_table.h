#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// A molecule as the rows of the paper's tables know it.
struct MoleculeRow {
  const RecordSet* records = nullptr;
  std::string name;
  std::string title;                     ///< a stand-in is called one
  std::optional<std::string> paper_row;  ///< empty: the paper has no such molecule

  [[nodiscard]] const RecordSet::Json* record(std::string_view method) const { return records->find(name, method); }
};

/// A column and what stands in it in a molecule's row.
struct MoleculeColumn {
  Column head;
  std::function<Cell(const MoleculeRow&)> cell;
};

/// A table with one row a molecule; the first column, the molecule's title, is added.
Table molecule_table(const RecordSet& records, std::string name, std::string caption, const std::vector<MoleculeColumn>& columns);

std::vector<MoleculeRow> molecule_rows(const RecordSet& records);

/// A column of the paper's table `number`, its values as printed there.
MoleculeColumn paper_column(int number, const std::string& paper_id, std::string title);

/// The number at a JSON pointer of the record, nothing when the case failed or has none. For a column that tells of the case as a whole:
/// "failed: <reason>", "not installed" or "not run" in its place.
Cell count_of(const RecordSet::Json* record, const std::string& pointer);
Cell count_or_reason(const RecordSet::Json* record, const std::string& pointer);

/// Notes that hold for every table: which cases have other options, which molecules are stand-ins, what the paper is, which dash means what.
std::vector<std::string> common_notes(const RecordSet& records);

}  // namespace smopt::experiments
