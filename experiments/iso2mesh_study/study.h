#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "baselines/iso2mesh/resample.h"
#include "baselines/iso2mesh/smoothsurf.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// One way of running ISO2mesh.
struct Iso2meshSetting {
  baselines::CollapsePlacement placement = baselines::CollapsePlacement::midpoint;
  baselines::SmoothsurfOptions smoothing;
};

/// What it makes of a mesh.
struct Iso2meshOutcome {
  Iso2meshSetting setting;
  std::size_t vertices = 0;
  std::optional<double> area_change, volume_change;  ///< relative to the mesh it was given; volume: where both enclose one
  std::optional<std::size_t> pairs;                  ///< intersecting pairs; not counted where the area has more than doubled
  std::optional<double> min_angle_deg;
  std::optional<double> median_edge_ratio;
  std::optional<int> diverged_at_step;
};

/// The settings that are tried.
struct Iso2meshGrid {
  std::vector<double> alphas = {0.1, 0.25, 0.5, 0.75, 1};  ///< 0.5 is ISO2mesh's default
  std::vector<int> rounds = {0, 3, 10, 30, 100};           ///< 100 is the paper's; 0 is run once a placement: the resampling alone
};

/// All settings of the grid for both placements and all three smoothers. Order: placement, smoother, alpha, rounds.
std::vector<Iso2meshSetting> settings_of(const Iso2meshGrid& grid);

/// Resamples a copy of the mesh to `vertices` vertices, without rounding its positions, and smooths it, for each setting, and measures the result.
/// \param tell  called with a line before each setting. \throws what `resample` and `smoothsurf` throw.
std::vector<Iso2meshOutcome> run_iso2mesh_study(const TriangleMesh& mesh, std::size_t vertices, const Iso2meshGrid& grid,
                                                const std::function<void(const std::string&)>& tell = {});

/// How far area and volume are from kept: the larger of the two changes without its sign; infinite where one does not exist.
double deviation(const Iso2meshOutcome& outcome);

/// The outcome after `rounds` rounds whose area and volume are nearest to those of the mesh that was given; null where none has that many.
const Iso2meshOutcome* closest(const std::vector<Iso2meshOutcome>& outcomes, int rounds);

/// The outcomes after `rounds` rounds by how near their intersecting pairs are to `pairs`, at most `count` of them.
std::vector<const Iso2meshOutcome*> nearest_by_pairs(const std::vector<Iso2meshOutcome>& outcomes, int rounds, std::size_t pairs,
                                                     std::size_t count);

}  // namespace smopt::experiments
