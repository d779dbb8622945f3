#include "experiments/convergence/published_table.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "experiments/convergence/study_cells.h"

namespace smopt::experiments {
namespace {

/// How far out a surface lies that encloses this volume, on average over the limit's area.
Cell offset_cell(const MoleculeStudy& study, const std::optional<double>& volume) {
  if (!volume) return {};
  return Decimal{(*volume - study.volume.value) / study.area.value, 3};
}

std::vector<Cell> published_cells(const MoleculeStudy& study, const PublishedMesh& mesh, std::string_view program) {
  return {mesh.title,
          fmt::format("{}, e = {}", program, mesh.option_e),
          counted(mesh.vertices),
          counted(mesh.components),
          counted(mesh.euler_characteristic),
          counted(mesh.euler_characteristic_main),
          decimal_cell(mesh.area, 0),
          decimal_cell(mesh.volume, 0),
          offset_cell(study, mesh.volume),
          Cell(),
          Cell()};
}

std::vector<Cell> our_cells(const MoleculeStudy& study, std::string name, const SurfaceSummary& surface) {
  return {study.dataset.title,
          std::move(name),
          counted(surface.all.vertices),
          counted(surface.components),
          counted(surface.all.euler_characteristic),
          counted(surface.main.euler_characteristic),
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
          counted(finest.components),
          counted(finest.all.euler_characteristic),
          counted(finest.main.euler_characteristic),
          Decimal{study.area.value, 0},
          Decimal{study.volume.value, 0},
          Decimal{0, 3},
          Decimal{study.main_area.value, 0},
          Decimal{study.main_volume.value, 0}};
}

}  // namespace

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

}  // namespace smopt::experiments
