#include "experiments/convergence/convergence_tables.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "experiments/convergence/study_cells.h"

namespace smopt::experiments {
namespace {

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

std::vector<Cell> surface_cells(std::string name, const SurfaceSummary& surface) {
  return {std::move(name),
          counted(surface.all.vertices),
          counted(surface.all.euler_characteristic),
          counted(surface.components),
          counted(surface.cavities),
          counted(surface.specks),
          counted(surface.main.euler_characteristic),
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
    const Cell changed = study.steps.empty() ? Cell() : counted(study.steps.back().changes.size());
    table.rows.push_back({study.dataset.title, Decimal{study.area.value, 1}, Decimal{study.area.residual, 1}, Decimal{study.area.order, 2},
                          Decimal{study.volume.value, 1}, Decimal{study.volume.residual, 1}, Decimal{study.volume.order, 2},
                          Decimal{finest.all.area, 1}, Decimal{finest.all.volume, 1}, counted(finest.all.euler_characteristic),
                          counted(finest.cavities), counted(finest.main.euler_characteristic), changed});
  }
  return table;
}

}  // namespace smopt::experiments
