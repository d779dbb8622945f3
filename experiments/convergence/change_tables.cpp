#include "experiments/convergence/change_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/convergence/study_cells.h"

namespace smopt::experiments {
namespace {

std::string with_sign(std::int64_t change) {
  return change == 0 ? "0" : fmt::format("{:+}", change);
}

struct PlacedChange {
  const MoleculeStudy* study;
  const ChangeStep* step;
  const ExplainedChange* change;
};

std::vector<PlacedChange> all_changes(std::span<const MoleculeStudy> studies) {
  std::vector<PlacedChange> all;
  for (const MoleculeStudy& study : studies) {
    for (const ChangeStep& step : study.steps) {
      for (const ExplainedChange& change : step.changes) all.push_back({&study, &step, &change});
    }
  }
  return all;
}

std::int64_t count_explained(const ChangeStep& step, Explanation explanation) {
  return std::count_if(step.changes.begin(), step.changes.end(), [=](const auto& change) { return change.explanation == explanation; });
}

std::int64_t euler_change(const ChangeStep& step) {
  return std::accumulate(step.changes.begin(), step.changes.end(), std::int64_t{0},
                         [](std::int64_t sum, const ExplainedChange& change) { return sum + change.place.change; });
}

/// The largest ratio of a step's changes; of those without any critical point there is none.
std::optional<double> largest_ratio(const ChangeStep& step) {
  std::optional<double> largest;
  for (const ExplainedChange& change : step.changes) {
    if (change.ratio()) largest = std::max(largest.value_or(0), *change.ratio());
  }
  return largest;
}

/// Whether what E implies does not hold: no critical point there has so small a |φ − c| that a surface within E may miss it.
bool exceeds(const ExplainedChange& change) {
  return !change.ratio() || *change.ratio() > 1;
}

std::int64_t count_exceeding(const ChangeStep& step) {
  return std::count_if(step.changes.begin(), step.changes.end(), exceeds);
}

/// Changes without a critical point come first.
double hardness(const PlacedChange& placed) {
  return placed.change->ratio().value_or(HUGE_VAL);
}

std::string index_name(const CriticalPoint& point) {
  constexpr std::array<std::string_view, 4> kNames = {"pocket (0)", "wall (1)", "neck (2)", "part (3)"};
  return std::string(kNames[static_cast<std::size_t>(point.index())]);
}

std::vector<Cell> change_cells(const PlacedChange& placed) {
  const ExplainedChange& change = *placed.change;
  std::vector<Cell> cells = {placed.study->dataset.title, fmt::format("{} → {}", placed.step->coarser_error, placed.step->finer_error),
                             with_sign(change.place.change)};
  if (change.points.empty()) {
    cells.insert(cells.end(), 6, Cell());
  } else {
    const ExplainingPoint& point = change.points.front();
    const Vec3& at = point.point.position;
    cells.emplace_back(fmt::format("({:.2f}, {:.2f}, {:.2f})", at.x(), at.y(), at.z()));
    cells.emplace_back(index_name(point.point));
    cells.emplace_back(Decimal{point.point.value - placed.study->dataset.surface.isovalue, kDistanceDecimals});
    cells.emplace_back(decimal_cell(point.coarser, kDistanceDecimals));
    cells.emplace_back(decimal_cell(point.finer, kDistanceDecimals));
    cells.emplace_back(Decimal{point.ratio, 3});
  }
  cells.emplace_back(Decimal{change.largest_distance, 3});
  cells.emplace_back(decimal_cell(change.least_bend_radius, 3));
  cells.emplace_back(fmt::format("{} → {}", change.specks_before, change.specks_after));
  cells.emplace_back(std::string(to_string(change.explanation)));
  return cells;
}

}  // namespace

Table change_table(std::span<const MoleculeStudy> studies) {
  Table table;
  table.name = "changes";
  table.caption = "Places where the topology changes from one error to the next";
  table.columns = {{"molecule", "molecule"},   {"step_A", "E (Å)"},   {"chi", "change of χ"}, {"places", "places"},
                   {"passed", "passed"},       {"specks", "specks"},  {"beside", "beside"},   {"none", "none"},
                   {"ratio", "largest ratio"}, {"above_1", "above 1"}};
  for (const MoleculeStudy& study : studies) {
    for (const ChangeStep& step : study.steps) {
      table.rows.push_back({study.dataset.title, fmt::format("{} → {}", step.coarser_error, step.finer_error),
                            with_sign(euler_change(step)), counted(step.changes.size()),
                            counted(count_explained(step, Explanation::passed)), counted(count_explained(step, Explanation::specks)),
                            counted(count_explained(step, Explanation::beside)), counted(count_explained(step, Explanation::none)),
                            decimal_cell(largest_ratio(step), 3), counted(count_exceeding(step))});
    }
  }
  return table;
}

Table event_table(std::span<const MoleculeStudy> studies) {
  std::map<std::string, std::int64_t> counts;
  for (const PlacedChange& placed : all_changes(studies)) {
    for (const ExplainingPoint& point : placed.change->points) {
      if (placed.change->explanation == Explanation::passed) ++counts[std::string(event_name(point.point, *point.finer >= 0))];
      if (placed.change->explanation == Explanation::beside) ++counts["beside a " + index_name(point.point)];
    }
  }
  Table table;
  table.name = "events";
  table.caption = "What happened, counted over all molecules and steps";
  table.columns = {{"event", "event"}, {"count", "count"}};
  for (const auto& [event, number] : counts) table.rows.push_back({event, counted(number)});
  return table;
}

Table hardest_changes_table(std::span<const MoleculeStudy> studies, std::size_t least) {
  std::vector<PlacedChange> changes = all_changes(studies);
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return hardness(a) > hardness(b); });
  const auto exceeding = static_cast<std::size_t>(
      std::count_if(changes.begin(), changes.end(), [](const PlacedChange& placed) { return exceeds(*placed.change); }));
  changes.resize(std::min(changes.size(), std::max(least, exceeding)));

  Table table;
  table.name = "hardest";
  table.caption = fmt::format("The changes with the largest ratio ({} of {})", changes.size(), all_changes(studies).size());
  table.columns = {{"molecule", "molecule"},
                   {"step_A", "E (Å)"},
                   {"chi", "Δχ"},
                   {"position_A", "critical point (Å)"},
                   {"kind", "kind (index)"},
                   {"value", "φ − c"},
                   {"coarser", "interpolant, coarser"},
                   {"finer", "finer"},
                   {"ratio", "ratio"},
                   {"distance_A", "distance of vertices (Å)"},
                   {"bend_A", "bend radius (Å)"},
                   {"specks", "specks"},
                   {"explanation", "explanation"}};
  for (const PlacedChange& placed : changes) table.rows.push_back(change_cells(placed));
  return table;
}

}  // namespace smopt::experiments
