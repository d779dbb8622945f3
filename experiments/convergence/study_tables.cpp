#include "experiments/convergence/study_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

namespace smopt::experiments {
namespace {

constexpr int kDistanceDecimals = 4;

Cell count(std::size_t n) {
  return static_cast<long>(n);
}

Cell count(std::int64_t n) {
  return static_cast<long>(n);
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

std::string with_sign(std::int64_t change) {
  return change == 0 ? "0" : fmt::format("{:+}", change);
}

// ---- convergence ----

std::vector<Cell> surface_cells(std::string name, const SurfaceSummary& surface) {
  return {std::move(name),
          count(surface.all.vertices),
          count(surface.all.euler_characteristic),
          count(surface.components),
          count(surface.cavities),
          count(surface.specks),
          count(surface.main.euler_characteristic),
          Decimal{surface.all.area, 1},
          Decimal{surface.all.volume, 1}};
}

void add_nearness(std::vector<Cell>& cells, double edge, const std::optional<Nearness>& nearness) {
  cells.emplace_back(Decimal{edge, kDistanceDecimals});
  if (!nearness) {
    cells.insert(cells.end(), 3, Cell());
    return;
  }
  cells.emplace_back(Decimal{nearness->distance.largest, kDistanceDecimals});
  cells.emplace_back(Decimal{nearness->distance.mean, kDistanceDecimals});
  cells.emplace_back(percent(nearness->sharp_share));
}

// ---- changes ----

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

// ---- the published program ----

/// How far out a surface lies that encloses this volume, on average over the limit's area.
Cell offset_cell(const MoleculeStudy& study, const std::optional<double>& volume) {
  if (!volume) return {};
  return Decimal{(*volume - study.volume.value) / study.area.value, 3};
}

std::vector<Cell> published_cells(const MoleculeStudy& study, const PublishedMesh& mesh, std::string_view program) {
  return {mesh.title,
          fmt::format("{}, e = {}", program, mesh.option_e),
          count(mesh.vertices),
          count(mesh.components),
          count(mesh.euler_characteristic),
          count(mesh.euler_characteristic_main),
          decimal_cell(mesh.area, 0),
          decimal_cell(mesh.volume, 0),
          offset_cell(study, mesh.volume),
          Cell(),
          Cell()};
}

std::vector<Cell> our_cells(const MoleculeStudy& study, std::string name, const SurfaceSummary& surface) {
  return {study.dataset.title,
          std::move(name),
          count(surface.all.vertices),
          count(surface.components),
          count(surface.all.euler_characteristic),
          count(surface.main.euler_characteristic),
          Decimal{surface.all.area, 0},
          Decimal{surface.all.volume, 0},
          offset_cell(study, surface.all.volume),
          Decimal{surface.main.area, 0},
          Decimal{surface.main.volume, 0}};
}

std::vector<Cell> limit_cells(const MoleculeStudy& study) {
  const SurfaceSummary& finest = study.adaptive.back().surface;
  return {study.dataset.title,
          std::string("limit"),
          Cell(),
          count(finest.components),
          count(finest.all.euler_characteristic),
          count(finest.main.euler_characteristic),
          Decimal{study.area.value, 0},
          Decimal{study.volume.value, 0},
          Decimal{0, 3},
          Decimal{study.main_area.value, 0},
          Decimal{study.main_volume.value, 0}};
}

}  // namespace

Table convergence_table(const MoleculeStudy& study) {
  Table table;
  table.name = "convergence-" + study.dataset.name;
  table.caption = fmt::format("{}: {} atoms, decay {} 1/Å², isovalue {}{}", study.dataset.title, study.atoms, study.dataset.surface.decay,
                              study.dataset.surface.isovalue,
                              study.raised_radii > 0 ? fmt::format("; {} radii raised to 0.6 Å", study.raised_radii) : "");
  table.columns = {{"surface", "E or spacing (Å)"}, {"vertices", "vertices"},           {"chi", "χ"},
                   {"components", "components"},    {"cavities", "cavities"},           {"specks", "specks"},
                   {"chi_main", "χ main"},          {"area_A2", "area (Å²)"},           {"volume_A3", "volume (Å³)"},
                   {"cell_A", "smallest cell"},     {"largest_A", "distance, largest"}, {"mean_A", "mean"},
                   {"sharp", "bent sharper"}};
  for (const AdaptiveRow& row : study.adaptive) {
    table.rows.push_back(surface_cells(fmt::format("E {}", row.error), row.surface));
    add_nearness(table.rows.back(), row.finest_edge, row.nearness);
  }
  for (const UniformRow& row : study.uniform) {
    table.rows.push_back(surface_cells(fmt::format("grid {:.5g}", row.spacing), row.surface));
    add_nearness(table.rows.back(), row.spacing, row.nearness);
  }
  return table;
}

Table limit_table(std::span<const MoleculeStudy> studies) {
  Table table;
  table.name = "limits";
  table.caption = "What area and volume tend to, and the topology at the least error";
  table.columns = {{"molecule", "molecule"},
                   {"area_A2", "area (Å²)"},
                   {"area_residual", "± residual"},
                   {"area_order", "order seen"},
                   {"volume_A3", "volume (Å³)"},
                   {"volume_residual", "± residual"},
                   {"volume_order", "order seen"},
                   {"adaptive_area", "area at least E"},
                   {"adaptive_volume", "volume at least E"},
                   {"chi", "χ"},
                   {"cavities", "cavities"},
                   {"chi_main", "χ main"},
                   {"changed", "places changed in the last step"}};
  for (const MoleculeStudy& study : studies) {
    const SurfaceSummary& finest = study.adaptive.back().surface;
    const Cell changed = study.steps.empty() ? Cell() : count(study.steps.back().changes.size());
    table.rows.push_back({study.dataset.title, Decimal{study.area.value, 1}, Decimal{study.area.residual, 1}, Decimal{study.area.order, 2},
                          Decimal{study.volume.value, 1}, Decimal{study.volume.residual, 1}, Decimal{study.volume.order, 2},
                          Decimal{finest.all.area, 1}, Decimal{finest.all.volume, 1}, count(finest.all.euler_characteristic),
                          count(finest.cavities), count(finest.main.euler_characteristic), changed});
  }
  return table;
}

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
                            with_sign(euler_change(step)), count(step.changes.size()), count(count_explained(step, Explanation::passed)),
                            count(count_explained(step, Explanation::specks)), count(count_explained(step, Explanation::beside)),
                            count(count_explained(step, Explanation::none)), decimal_cell(largest_ratio(step), 3),
                            count(count_exceeding(step))});
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
  for (const auto& [event, number] : counts) table.rows.push_back({event, count(number)});
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

Table published_table(std::span<const MoleculeStudy> studies) {
  Table table;
  table.name = "published";
  table.caption = fmt::format("{} beside this program", published_figures().program);
  table.columns = {{"molecule", "molecule"},
                   {"surface", "surface"},
                   {"vertices", "vertices"},
                   {"components", "components"},
                   {"chi", "χ"},
                   {"chi_main", "χ main"},
                   {"area_A2", "area (Å²)"},
                   {"volume_A3", "volume (Å³)"},
                   {"offset_A", "mean offset (Å)"},
                   {"area_main", "area, main"},
                   {"volume_main", "volume, main"}};
  for (const MoleculeStudy& study : studies) {
    if (study.published.empty()) continue;
    for (const PublishedComparison& comparison : study.published) {
      table.rows.push_back(published_cells(study, comparison.published, published_figures().program));
      table.rows.push_back(our_cells(study, fmt::format("ours, E = {} Å", comparison.ours.error), comparison.ours.surface));
    }
    table.rows.push_back(our_cells(study, fmt::format("ours, grid {} Å", study.uniform.front().spacing), study.uniform.front().surface));
    table.rows.push_back(limit_cells(study));
  }
  return table;
}

std::string edge_ratio_bars(const metrics::Histogram& histogram) {
  constexpr std::size_t kLines = 10;
  constexpr double kCharactersPerShare = 150;  // a third of the triangles are fifty characters
  const std::size_t per_line = histogram.counts.size() / kLines;
  const double all = static_cast<double>(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}));
  std::string text;
  for (std::size_t line = 0; line < kLines; ++line) {
    const auto first = histogram.counts.begin() + static_cast<std::ptrdiff_t>(line * per_line);
    const double share = static_cast<double>(std::accumulate(first, first + static_cast<std::ptrdiff_t>(per_line), std::size_t{0})) / all;
    std::string bar;
    for (long i = 0; i < std::lround(share * kCharactersPerShare); ++i) bar += "█";
    text += fmt::format("{:.1f}–{:.1f} {:5.1f} %  {}\n", histogram.edges[line * per_line], histogram.edges[(line + 1) * per_line],
                        100 * share, bar);
  }
  return text;
}

}  // namespace smopt::experiments
