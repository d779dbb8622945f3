#include "experiments/tables/methods_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

#include "experiments/level_set_run.h"
#include "experiments/method_cases.h"
#include "experiments/tables/molecule_table.h"
#include "experiments/tetgen_trials.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

/// A column and what stands in it in a case's row.
struct CaseColumn {
  Column head;
  std::function<Cell(const Json&)> cell;
};

CaseColumn count_column(std::string id, std::string title, std::string pointer) {
  return {{std::move(id), std::move(title)}, [pointer](const Json& record) { return count_cell(number_at(&record, pointer)); }};
}

CaseColumn number_column(std::string id, std::string title, std::string pointer, double factor, int decimals) {
  return {{std::move(id), std::move(title)}, [=](const Json& record) {
            const auto value = number_at(&record, pointer);
            return value ? Cell(Decimal{factor * *value, decimals}) : Cell();
          }};
}

bool is_initial(const Json& record) {
  return text_at(&record, "/method") == kInitial;
}

/// Per cent against the mesh that the method was given; nothing for that mesh as generated.
CaseColumn change_column(std::string id, std::string title, const std::string& quantity) {
  return {{std::move(id), std::move(title)}, [quantity](const Json& record) {
            const auto before = number_at(&record, "/metrics/before/" + quantity), after = number_at(&record, "/metrics/after/" + quantity);
            return before && after && *before != 0 && !is_initial(record) ? Cell(Decimal{100 * (*after / *before - 1), 2}) : Cell();
          }};
}

/// The mean distance to the level set, as a multiple of that of the mesh that the method was given.
Cell level_set_ratio(const Json& record) {
  const auto before = number_at(&record, "/level_set_distance/before/mean"), after = number_at(&record, "/level_set_distance/after/mean");
  return before && after && *before > 0 ? Cell(Decimal{*after / *before, 2}) : Cell();
}

/// Those of a case's samples that are not in its mean distance to the level set.
double unresolved_samples(const Json& record) {
  return number_at(&record, "/level_set_distance/after/unresolved").value_or(0);
}

/// Of all that is the method's own: without the validity and the cavities, which come before any. Nothing for the mesh as generated.
Cell method_seconds(const Json& record) {
  const auto smoothing = number_at(&record, "/cpu_seconds/smoothing");
  if (is_initial(record) || !smoothing) return {};
  double sum = *smoothing;
  for (const char* stage : {"redundant", "resampling"}) sum += number_at(&record, std::string("/cpu_seconds/") + stage).value_or(0);
  return Decimal{sum, 3};
}

CaseColumn tetgen_column(const std::string& switches) {
  return {{"tetgen_" + switches, "TetGen -" + switches},
          [switches](const Json& record) { return text_cell(text_at(&record, "/tetgen/" + switches + "/status")); }};
}

/// Why the method stopped, or why there is no result.
Cell ending(const Json& record) {
  if (is_done(&record)) return text_cell(text_at(&record, "/stopped_because"));
  const std::string status = text_at(&record, "/status").value_or("failed");
  return status == "not installed" ? status : status + ": " + text_at(&record, "/reason").value_or("no reason given");
}

std::vector<CaseColumn> case_columns() {
  constexpr double kPerCent = 100;
  return {
      count_column("vertices", "Vertices", "/metrics/after/vertices"),
      count_column("intersecting_pairs", "Intersecting pairs", "/metrics/after/intersecting_pairs"),
      number_column("min_angle_deg", "Smallest angle (°)", "/metrics/after/angle_deg/min", 1, 3),
      number_column("max_angle_deg", "Largest angle (°)", "/metrics/after/angle_deg/max", 1, 2),
      number_column("below_10_percent", "Smallest angle < 10° (%)", "/metrics/after/min_angle_share/below_10", kPerCent, 2),
      number_column("below_30_percent", "< 30° (%)", "/metrics/after/min_angle_share/below_30", kPerCent, 2),
      number_column("edge_ratio_below_0.1_percent", "Edge ratio < 0.1 (%)", "/metrics/after/edge_ratio/below_0.1", kPerCent, 2),
      number_column("valence_5_6_7_percent", "Valence 5–7 (%)", "/metrics/after/valence/share_5_6_7", kPerCent, 2),
      change_column("area_change_percent", "Area (%)", "area"),
      change_column("volume_change_percent", "Volume (%)", "volume"),
      number_column("level_set_distance_mean_A", "Mean distance to the level set (Å)", "/level_set_distance/after/mean", 1, 4),
      {{"level_set_distance_ratio", "Level set (× before)"}, level_set_ratio},
      tetgen_column("p"),
      tetgen_column("pY"),
      tetgen_column(kQualitySwitches),
      {{"cpu_s_method", "CPU (s)"}, method_seconds},
      {{"ended", "Ended"}, ending},
  };
}

/// "AChE monomer, plain Laplacian: 12", for each case that is done and has samples without a foot.
std::vector<std::string> unresolved_cases(const RecordSet& records) {
  std::vector<std::string> cases;
  for (const MoleculeRow& row : molecule_rows(records))
    for (const std::string& method : records.methods())
      if (const Json* const record = row.record(method); is_done(record) && unresolved_samples(*record) > 0)
        cases.push_back(
            fmt::format("{}, {}: {:.0f}", row.title, text_at(record, "/method_title").value_or(method), unresolved_samples(*record)));
  return cases;
}

}  // namespace

Table methods_table(const RecordSet& records) {
  Table table{"methods", "All methods on the same meshes, under the same judge", {{"molecule", "Molecule"}, {"method", "Method"}}, {}, {}};
  const std::vector<CaseColumn> columns = case_columns();
  for (const CaseColumn& column : columns) table.columns.push_back(column.head);
  for (const MoleculeRow& row : molecule_rows(records)) {
    for (const std::string& method : records.methods()) {
      const Json* const record = row.record(method);
      if (record == nullptr) continue;
      std::vector<Cell>& cells = table.rows.emplace_back();
      cells.emplace_back(row.title);
      cells.push_back(text_cell(text_at(record, "/method_title")));
      for (const CaseColumn& column : columns) cells.push_back(column.cell(*record));
    }
  }
  table.notes.push_back(
      "Every method was given the initial mesh without its cavities; area and volume are changes against that mesh, and the distance to "
      "the "
      "level set of the molecule's field (over the area, not over the vertices) is held against its. Pairs are counted by CGAL's exact "
      "predicates. CPU seconds are the method's own on one thread, without validity and cavities, which come before any. "
      "\"—\" "
      "where there is no such number (coordinates that are not finite, a case that failed).");
  if (const std::vector<std::string> cases = unresolved_cases(records); !cases.empty())
    table.notes.push_back(fmt::format("Samples without a foot on the level set, of {}, which are left out of the mean: {}.",
                                      kLevelSetSamples, fmt::join(cases, "; ")));
  return table;
}

}  // namespace smopt::experiments
