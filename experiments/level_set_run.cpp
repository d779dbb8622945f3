#include "experiments/level_set_run.h"

#include "metrics/surface_samples.h"

namespace smopt::experiments {

std::optional<LevelSetDistance> LevelSet::distance(const TriangleMesh& mesh, std::size_t samples) const {
  const std::vector<Vec3> points = metrics::sample_surface(mesh, samples);
  return points.empty() ? std::nullopt : std::optional(distance_to_level_set(field_, isovalue_, points));
}

nlohmann::ordered_json to_json(const std::optional<LevelSetDistance>& distance) {
  if (!distance) return nullptr;
  return {{"mean", distance->mean}, {"largest", distance->largest}, {"unresolved", distance->unresolved}};
}

}  // namespace smopt::experiments
