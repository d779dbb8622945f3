#include "experiments/tables/table2.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "experiments/run_report.h"
#include "experiments/tables/molecule_table.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

constexpr int kNumber = 2;
constexpr int kDecimals = 3;       // milliseconds: small molecules take a few hundredths of a second
constexpr int kRatioDecimals = 2;  // repeats differ by some per cent

/// The median over the repeats of the processor seconds of some stages together.
std::optional<double> cpu_seconds(const Json* record, const std::vector<std::string>& stages) {
  if (!is_done(record) || !record->contains("repeats")) return std::nullopt;
  std::vector<double> sums;
  for (const Json& repeat : record->at("repeats")) {
    double sum = 0;
    for (const std::string& stage : stages) sum += number_at(&repeat, "/cpu_seconds/" + stage).value_or(0);
    sums.push_back(sum);
  }
  return sums.empty() ? std::nullopt : std::optional(median(std::move(sums)));
}

MoleculeColumn seconds_column(std::string id, std::string title, std::string method, std::vector<std::string> stages) {
  return {{std::move(id), std::move(title)},
          [method, stages](const MoleculeRow& row) { return decimal_cell(cpu_seconds(row.record(method), stages), kDecimals); }};
}

Cell smoothing_ratio(const MoleculeRow& row) {
  const auto smopt = cpu_seconds(row.record("smopt"), {"smoothing"});
  const auto laplacian = cpu_seconds(row.record("laplacian"), {"smoothing"});
  return smopt && laplacian && *laplacian > 0 ? Cell(Decimal{*smopt / *laplacian, kRatioDecimals}) : Cell();
}

/// "CPU: …; g++ …" of every machine that made one of the records.
std::string machine_note(const RecordSet& records) {
  std::set<std::string> machines;
  for (const std::string& molecule : records.molecules()) {
    for (const std::string& method : records.methods()) {
      const Json* record = records.find(molecule, method);
      if (record != nullptr)
        machines.insert(fmt::format("{}, {}", text_at(record, "/machine/cpu").value_or("unknown processor"),
                                    text_at(record, "/compiler").value_or("unknown compiler")));
    }
  }
  return fmt::format("Here: {}; one thread, medians over the repeats. The paper: Intel Xeon E5-4650 v2, 2.4 GHz.",
                     fmt::join(machines, "; "));
}

/// What the floor is that SMOPT's time is compared with; nothing where it did not run.
std::optional<std::string> laplacian_note(const RecordSet& records) {
  for (const std::string& molecule : records.molecules())
    if (const auto rounds = number_at(records.find(molecule, "laplacian"), "/options/rounds"))
      return fmt::format("Plain Laplacian: {:.0f} rounds over all vertices of the same mesh without its cavities, without any test.",
                         *rounds);
  return std::nullopt;
}

}  // namespace

Table table2(const RecordSet& records) {
  Table table = molecule_table(
      records, "table2", "Table 2. CPU time (s) of the improvement by SMOPT",
      {{{"vertices_initial", "Vertices, initial"},
        [](const MoleculeRow& row) { return count_or_reason(row.record("initial"), "/metrics/after/vertices"); }},
       paper_column(kNumber, "vertices_initial", "paper"),
       {{"vertices_improved", "Vertices, improved"},
        [](const MoleculeRow& row) { return count_or_reason(row.record("smopt"), "/metrics/after/vertices"); }},
       paper_column(kNumber, "vertices_improved", "paper"),
       seconds_column("cpu_s_manifold_and_cavities", "Manifold check and cavities (s)", "smopt", {"validity", "cavities"}),
       paper_column(kNumber, "cpu_s_manifold_and_cavities", "paper"),
       seconds_column("cpu_s_redundant_points_and_smoothing", "Redundant points and smoothing (s)", "smopt", {"redundant", "smoothing"}),
       paper_column(kNumber, "cpu_s_redundant_points_and_smoothing", "paper"),
       seconds_column("cpu_s_smoothing", "of this, smoothing (s)", "smopt", {"smoothing"}),
       seconds_column("cpu_s_plain_laplacian", "Plain Laplacian smoothing (s)", "laplacian", {"smoothing"}),
       {{"smoothing_to_plain_laplacian", "SMOPT's smoothing / plain Laplacian"}, smoothing_ratio}});
  table.notes.push_back(machine_note(records));
  if (const auto note = laplacian_note(records)) table.notes.push_back(*note);
  return table;
}

}  // namespace smopt::experiments
