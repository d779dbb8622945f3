#include "experiments/tables/table1.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/tables/molecule_table.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

constexpr int kNumber = 1;

MoleculeColumn size_column(std::string id, std::string title, std::string method, std::string pointer) {
  return {{std::move(id), std::move(title)},
          [method, pointer](const MoleculeRow& row) { return count_or_reason(row.record(method), pointer); }};
}

MoleculeColumn triangles_column(std::string id, std::string title, std::string method) {
  return {{std::move(id), std::move(title)},
          [method](const MoleculeRow& row) { return count_of(row.record(method), "/metrics/after/triangles"); }};
}

Cell solvation_cell(const Json* record) {
  if (!is_done(record)) return {};
  const std::string status = text_at(record, "/solvation/status").value_or("not computed");
  return status == "not computed" ? Cell("not yet computed") : Cell(status);
}

MoleculeColumn solvation_column(std::string id, std::string title, std::string method) {
  return {{std::move(id), std::move(title)}, [method](const MoleculeRow& row) { return solvation_cell(row.record(method)); }};
}

/// "Success", or "Failed" with the reason.
Cell tetgen_cell(const Json* record, const std::string& switches) {
  if (!is_done(record)) return {};
  const std::string at = "/tetgen/" + switches;
  const auto status = text_at(record, at + "/status");
  if (!status) return {};
  if (*status == "success") return "Success";
  return "Failed: " + text_at(record, at + "/reason").value_or("no reason given");
}

MoleculeColumn tetgen_column(std::string id, std::string title, std::string method, std::string switches) {
  return {{std::move(id), std::move(title)},
          [method, switches](const MoleculeRow& row) { return tetgen_cell(row.record(method), switches); }};
}

bool tetgen_succeeds(const Json* record, const std::string& switches) {
  return is_done(record) && text_at(record, "/tetgen/" + switches + "/status") == "success";
}

/// The paper's "Failed" is compared, never staged: where TetGen takes the initial mesh too, that is said.
std::string initial_success_note(const RecordSet& records, const std::string& switches) {
  std::vector<std::string> titles;
  for (const MoleculeRow& row : molecule_rows(records))
    if (tetgen_succeeds(row.record("initial"), switches)) titles.push_back(row.title);
  if (titles.empty()) return fmt::format("TetGen -{} succeeds on none of the initial meshes here.", switches);
  return fmt::format("TetGen -{} succeeds on the initial mesh too (the paper: Failed, for its meshes) for: {}.", switches,
                     fmt::join(titles, ", "));
}

}  // namespace

Table table1(const RecordSet& records) {
  Table table =
      molecule_table(records, "table1", "Table 1. Mesh sizes before and after improvement by SMOPT, and success of AFMPB and TetGen",
                     {{{"atoms", "Atoms"},
                       [](const MoleculeRow& row) { return count_cell(number_at(&row.records->any_of(row.name), "/molecule/atoms")); }},
                      paper_column(kNumber, "atoms", "paper"),
                      size_column("vertices_initial", "Vertices, initial", "initial", "/metrics/after/vertices"),
                      paper_column(kNumber, "vertices_initial", "paper"),
                      size_column("vertices_improved", "Vertices, improved", "smopt", "/metrics/after/vertices"),
                      paper_column(kNumber, "vertices_improved", "paper"),
                      triangles_column("triangles_initial", "Triangles, initial", "initial"),
                      paper_column(kNumber, "triangles_initial", "paper"),
                      triangles_column("triangles_improved", "Triangles, improved", "smopt"),
                      paper_column(kNumber, "triangles_improved", "paper"),
                      solvation_column("afmpb_initial_kcal_per_mol", "AFMPB, initial (kcal/mol)", "initial"),
                      paper_column(kNumber, "afmpb_initial", "paper"),
                      solvation_column("afmpb_improved_kcal_per_mol", "AFMPB, improved (kcal/mol)", "smopt"),
                      paper_column(kNumber, "afmpb_improved_kcal_per_mol", "paper"),
                      tetgen_column("tetgen_p_initial", "TetGen -p, initial", "initial", "p"),
                      tetgen_column("tetgen_pY_initial", "TetGen -pY, initial", "initial", "pY"),
                      paper_column(kNumber, "tetgen_initial", "paper"),
                      tetgen_column("tetgen_p_improved", "TetGen -p, improved", "smopt", "p"),
                      tetgen_column("tetgen_pY_improved", "TetGen -pY, improved", "smopt", "pY"),
                      paper_column(kNumber, "tetgen_improved", "paper")});
  for (const char* switches : {"p", "pY"}) table.notes.push_back(initial_success_note(records, switches));
  table.notes.push_back("AFMPB stands for the boundary-element Poisson-Boltzmann solution, which is not yet computed here.");
  return table;
}

}  // namespace smopt::experiments
