#include "experiments/tables/table3.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/record.h"
#include "experiments/tables/molecule_table.h"

namespace smopt::experiments {
namespace {

constexpr int kNumber = 3;

/// The methods of the paper's table, which are shown whether they ran here or not.
constexpr std::array<const char*, 3> kPaperMethods = {"initial", "smopt", "iso2mesh"};

bool is_in_paper(const std::string& method) {
  return std::find(kPaperMethods.begin(), kPaperMethods.end(), method) != kPaperMethods.end();
}

/// Those that ran and belong beside the paper's, and the paper's that did not run.
std::vector<std::string> shown_methods(const RecordSet& records) {
  std::vector<std::string> methods = paper_methods(records);
  for (const char* method : kPaperMethods)
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.emplace_back(method);
  return methods;
}

/// One quantity for every method, the paper's value beside ours.
void add_columns(std::vector<MoleculeColumn>& columns, const RecordSet& records, const std::string& id, const std::string& title,
                 const std::function<Cell(const RecordSet::Json*)>& cell) {
  const std::vector<std::string> run = records.methods();
  for (const std::string& method : shown_methods(records)) {
    const std::string column_id = id + "_" + method;
    const std::string column_title = title + ", " + method_title(records, method);
    const bool has_run = std::find(run.begin(), run.end(), method) != run.end();
    if (has_run)
      columns.push_back({{column_id, column_title}, [method, cell](const MoleculeRow& row) { return cell(row.record(method)); }});
    if (is_in_paper(method)) columns.push_back(paper_column(kNumber, column_id, has_run ? "paper" : column_title + " (paper)"));
  }
}

/// Which results are no surfaces any more: "MeshLab diverged at step 36 on AChE monomer."
std::vector<std::string> divergence_notes(const RecordSet& records) {
  std::vector<std::string> notes;
  for (const std::string& method : paper_methods(records)) {
    for (const MoleculeRow& row : molecule_rows(records)) {
      const auto step = number_at(row.record(method), "/diverged_at_step");
      if (step) notes.push_back(fmt::format("{} diverged at step {:.0f} on {}.", method_title(records, method), *step, row.title));
    }
  }
  return notes;
}

}  // namespace

Table table3(const RecordSet& records) {
  std::vector<MoleculeColumn> columns;
  add_columns(columns, records, "vertices", "Vertices",
              [](const RecordSet::Json* record) { return count_or_reason(record, "/metrics/after/vertices"); });
  add_columns(columns, records, "intersecting_pairs", "Intersecting pairs",
              [](const RecordSet::Json* record) { return count_of(record, "/metrics/after/intersecting_pairs"); });
  Table table = molecule_table(records, "table3", "Table 3. Vertices and intersecting pairs of triangles", columns);
  table.notes.push_back(
      "Pairs are counted by CGAL's exact predicates. Every method was given the initial mesh without its cavities; \"initial\" is the mesh "
      "with them.");
  for (std::string& note : divergence_notes(records)) table.notes.push_back(std::move(note));
  return table;
}

}  // namespace smopt::experiments
