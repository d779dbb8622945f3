#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// A triangle that has the worst of something.
struct WorstPlace {
  FaceId triangle = 0;
  Vec3 point = Vec3::Zero();  ///< its centroid, Å
  double value = 0;           ///< degrees for an angle
};

/// Where a mesh is worst.
struct WorstPlaces {
  std::optional<WorstPlace> smallest_angle, largest_angle;  ///< empty where no triangle has finite corners
  std::optional<WorstPlace> intersection;  ///< the first triangle that meets another; empty where none does or none is counted
};

/// The first of several that are equally bad. Cost: that of `metrics::find_intersections`.
WorstPlaces find_worst_places(const TriangleMesh& mesh);

/// {"smallest_angle": {"triangle", "point", "value"}, …}; null for what is empty.
nlohmann::ordered_json to_json(const WorstPlaces& places);

}  // namespace smopt::experiments
