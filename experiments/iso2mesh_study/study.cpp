#include "experiments/iso2mesh_study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/iso2mesh_study/study_markdown.h"
#include "metrics/extent.h"
#include "metrics/intersections.h"
#include "metrics/shape.h"
#include "metrics/topology.h"

namespace smopt::experiments {
namespace {

using baselines::CollapsePlacement;
using baselines::SmoothsurfMethod;

constexpr std::array kPlacements = {CollapsePlacement::midpoint, CollapsePlacement::lindstrom_turk};
constexpr std::array kSmoothers = {SmoothsurfMethod::laplacian, SmoothsurfMethod::lowpass, SmoothsurfMethod::laplacianhc};

/// A surface of more than twice the area it had is a tangle in which every triangle meets thousands: counting its pairs takes hours and tells
/// nothing.
constexpr double kLargestAreaChange = 1;

metrics::Extent extent_of(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  return metrics::measure_extent(mesh, metrics::measure_topology(mesh, notes), notes);
}

std::optional<double> relative_change(const std::optional<double>& before, const std::optional<double>& after) {
  return before && after && *before != 0 ? std::optional(*after / *before - 1) : std::nullopt;
}

Iso2meshOutcome outcome_of(const Iso2meshSetting& setting, TriangleMesh mesh, const metrics::Extent& before) {
  Iso2meshOutcome outcome;
  outcome.setting = setting;
  outcome.diverged_at_step = baselines::smoothsurf(mesh, setting.smoothing);
  const metrics::Extent after = extent_of(mesh);
  std::vector<std::string> notes;
  const metrics::Shape shape = metrics::measure_shape(mesh, notes);
  outcome.vertices = mesh.vertex_count();
  outcome.area_change = relative_change(before.area, after.area);
  outcome.volume_change = relative_change(before.volume, after.volume);
  if (outcome.area_change && *outcome.area_change <= kLargestAreaChange) outcome.pairs = metrics::find_intersections(mesh, {0}).count;
  outcome.min_angle_deg = shape.angle.min;
  outcome.median_edge_ratio = shape.edge_ratio.median;
  return outcome;
}

}  // namespace

std::vector<Iso2meshSetting> settings_of(const Iso2meshGrid& grid) {
  std::vector<Iso2meshSetting> settings;
  for (const CollapsePlacement placement : kPlacements) {
    if (std::find(grid.rounds.begin(), grid.rounds.end(), 0) != grid.rounds.end()) settings.push_back({placement, {{}, 0, 0}});
    for (const SmoothsurfMethod method : kSmoothers) {
      for (const double alpha : grid.alphas) {
        for (const int rounds : grid.rounds)
          if (rounds > 0) settings.push_back({placement, {method, rounds, alpha}});
      }
    }
  }
  return settings;
}

std::vector<Iso2meshOutcome> run_iso2mesh_study(const TriangleMesh& mesh, std::size_t vertices, const Iso2meshGrid& grid,
                                                const std::function<void(const std::string&)>& tell) {
  const metrics::Extent before = extent_of(mesh);
  std::vector<Iso2meshOutcome> outcomes;
  std::optional<CollapsePlacement> resampled_by;
  TriangleMesh resampled;
  for (const Iso2meshSetting& setting : settings_of(grid)) {
    if (tell) tell(describe(setting));
    if (resampled_by != setting.placement) {
      resampled = mesh;
      baselines::ResampleOptions options;
      options.vertices = vertices;
      options.placement = setting.placement;
      options.digits = 0;
      baselines::resample(resampled, options);
      resampled_by = setting.placement;
    }
    outcomes.push_back(outcome_of(setting, resampled, before));
  }
  return outcomes;
}

double deviation(const Iso2meshOutcome& outcome) {
  if (!outcome.area_change || !outcome.volume_change) return HUGE_VAL;
  return std::max(std::abs(*outcome.area_change), std::abs(*outcome.volume_change));
}

const Iso2meshOutcome* closest(const std::vector<Iso2meshOutcome>& outcomes, int rounds) {
  const Iso2meshOutcome* best = nullptr;
  for (const Iso2meshOutcome& outcome : outcomes) {
    if (outcome.setting.smoothing.rounds == rounds && (best == nullptr || deviation(outcome) < deviation(*best))) best = &outcome;
  }
  return best;
}

std::vector<const Iso2meshOutcome*> nearest_by_pairs(const std::vector<Iso2meshOutcome>& outcomes, int rounds, std::size_t pairs,
                                                     std::size_t count) {
  std::vector<const Iso2meshOutcome*> counted;
  for (const Iso2meshOutcome& outcome : outcomes)
    if (outcome.setting.smoothing.rounds == rounds && outcome.pairs) counted.push_back(&outcome);
  const auto distance = [pairs](const Iso2meshOutcome* outcome) {
    return std::max(pairs, *outcome->pairs) - std::min(pairs, *outcome->pairs);
  };
  std::stable_sort(counted.begin(), counted.end(), [&](const auto* a, const auto* b) { return distance(a) < distance(b); });
  counted.resize(std::min(count, counted.size()));
  return counted;
}

}  // namespace smopt::experiments
