#include "experiments/tables/table1.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "experiments/tables/molecule_table.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

constexpr int kNumber = 1;
constexpr const char* kSolved = "success";
constexpr const char* kDegenerate = "/solvation/degenerate_vertices";
constexpr const char* kOutside = "/solvation/charges_outside";

MoleculeColumn size_column(std::string id, std::string title, std::string method, std::string pointer) {
  return {{std::move(id), std::move(title)},
          [method, pointer](const MoleculeRow& row) { return count_or_reason(row.record(method), pointer); }};
}

MoleculeColumn count_column(std::string id, std::string title, std::string method, std::string pointer) {
  return {{std::move(id), std::move(title)}, [method, pointer](const MoleculeRow& row) { return count_of(row.record(method), pointer); }};
}

/// "not computed: only for Table 1", "not_converged: …": what stands in the place of an energy.
std::string solvation_outcome(const Json* record, const std::string& status) {
  const auto reason = text_at(record, "/solvation/reason");
  return reason ? fmt::format("{}: {}", status, *reason) : status;
}

std::optional<std::string> solvation_status(const Json* record) {
  return is_done(record) ? text_at(record, "/solvation/status") : std::nullopt;
}

/// The total energy where the solver ended well.
Cell solvation_cell(const Json* record) {
  constexpr int kDecimals = 1;  // the surface's influence is some kcal/mol
  const auto status = solvation_status(record);
  if (!status) return {};
  if (status == kSolved) return decimal_cell(number_at(record, "/solvation/total_kcal_per_mol"), kDecimals);
  return solvation_outcome(record, *status);
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

/// The paper's NaN is compared, never staged: where the solver takes the initial mesh too, that is said.
std::string initial_solvation_note(const RecordSet& records) {
  std::vector<std::string> solved;
  bool was_run = false;
  for (const MoleculeRow& row : molecule_rows(records)) {
    const auto status = solvation_status(row.record("initial"));
    if (!status || status == "not computed" || status == "over limit") continue;
    was_run = true;
    if (status == kSolved) solved.push_back(row.title);
  }
  if (!was_run) return "The solver was run on none of the initial meshes here.";
  if (solved.empty()) return "The solver converges on none of the initial meshes here.";
  return fmt::format("The solver converges on the initial mesh too (the paper: NaN, for its meshes) for: {}.", fmt::join(solved, ", "));
}

/// "AChE monomer, improved: polar -2130.1, nonpolar 2600.2 kcal/mol": a note for each energy in the table.
std::vector<std::string> energy_parts(const RecordSet& records) {
  std::vector<std::string> notes;
  for (const MoleculeRow& row : molecule_rows(records)) {
    for (const auto& [method, mesh] : {std::pair("initial", "initial"), std::pair("smopt", "improved")}) {
      const Json* record = row.record(method);
      const auto polar = number_at(record, "/solvation/polar_kcal_per_mol"),
                 nonpolar = number_at(record, "/solvation/nonpolar_kcal_per_mol");
      if (solvation_status(record) == kSolved && polar && nonpolar)
        notes.push_back(fmt::format("{}, {}: polar {:.1f}, nonpolar {:.1f} kcal/mol.", row.title, mesh, *polar, *nonpolar));
    }
  }
  return notes;
}

const char* solver_note() {
  return "AFMPB stands for this project's boundary-element solver of the linearised Poisson–Boltzmann equation, in AFMPB's formulation and "
         "with its defaults; energies are polar + nonpolar (0.005 · area + 0.035 · volume). The paper does not say which its column is: "
         "connexin's is positive, as a sum can be and a polar energy cannot; the AChE monomer's is near the polar energy below and far "
         "from the "
         "sum. Degenerate vertices are those whose normal AFMPB could not form, so that its answer would be NaN.";
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
                      count_column("triangles_initial", "Triangles, initial", "initial", "/metrics/after/triangles"),
                      paper_column(kNumber, "triangles_initial", "paper"),
                      count_column("triangles_improved", "Triangles, improved", "smopt", "/metrics/after/triangles"),
                      paper_column(kNumber, "triangles_improved", "paper"),
                      solvation_column("afmpb_initial_kcal_per_mol", "AFMPB, initial (kcal/mol)", "initial"),
                      paper_column(kNumber, "afmpb_initial", "paper"),
                      solvation_column("afmpb_improved_kcal_per_mol", "AFMPB, improved (kcal/mol)", "smopt"),
                      paper_column(kNumber, "afmpb_improved_kcal_per_mol", "paper"),
                      count_column("solver_iterations_initial", "Solver's iterations, initial", "initial", "/solvation/iterations"),
                      count_column("solver_iterations_improved", "Solver's iterations, improved", "smopt", "/solvation/iterations"),
                      count_column("charges_outside_initial", "Charges outside, initial", "initial", kOutside),
                      count_column("charges_outside_improved", "Charges outside, improved", "smopt", kOutside),
                      count_column("degenerate_vertices_initial", "Degenerate vertices, initial", "initial", kDegenerate),
                      count_column("degenerate_vertices_improved", "Degenerate vertices, improved", "smopt", kDegenerate),
                      tetgen_column("tetgen_p_initial", "TetGen -p, initial", "initial", "p"),
                      tetgen_column("tetgen_pY_initial", "TetGen -pY, initial", "initial", "pY"),
                      paper_column(kNumber, "tetgen_initial", "paper"),
                      tetgen_column("tetgen_p_improved", "TetGen -p, improved", "smopt", "p"),
                      tetgen_column("tetgen_pY_improved", "TetGen -pY, improved", "smopt", "pY"),
                      paper_column(kNumber, "tetgen_improved", "paper")});
  for (const char* switches : {"p", "pY"}) table.notes.push_back(initial_success_note(records, switches));
  table.notes.emplace_back(solver_note());
  table.notes.push_back(initial_solvation_note(records));
  for (std::string& note : energy_parts(records)) table.notes.push_back(std::move(note));
  return table;
}

}  // namespace smopt::experiments
