#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "metrics/distance.h"
#include "metrics/extent.h"
#include "metrics/shape.h"
#include "metrics/topology.h"
#include "metrics/valence.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Everything there is to say about one mesh. A number that does not exist is empty, and `notes` says why.
struct Measurement {
  Topology topology;
  Extent extent;
  std::optional<std::size_t> intersecting_pairs;  ///< see find_intersections
  Shape shape;
  Valence valence;
  std::optional<SurfaceDistance> distance;  ///< only when a reference was given
  std::vector<std::string> notes;           ///< "volume: the surface is not closed"
};

struct MeasureOptions {
  const TriangleMesh* reference = nullptr;  ///< distances to this surface are measured too; not owned
  DistanceOptions distance;
};

/// Measures any triangle soup, the empty one too. Cost: that of find_intersections; 2 M triangles take some seconds.
Measurement measure(const TriangleMesh& mesh, const MeasureOptions& options = {});

}  // namespace smopt::metrics
