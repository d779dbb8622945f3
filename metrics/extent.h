#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics/topology.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Area of a surface (Å²) and the volume it encloses (Å³), signed: positive where the normals point outwards.
struct Extent {
  std::optional<double> area;    ///< empty where a corner is not finite
  std::optional<double> volume;  ///< empty, too, unless the surface is closed and consistently oriented
};

/// Of all triangles, Å². Cost: O(n).
double surface_area(const TriangleMesh& mesh);

/// Area: the sum over the triangles. Volume: the divergence theorem, relative to the middle of the bounding box so that a mesh far from the
/// origin loses no digits; the volume of cavities (oriented inwards) is subtracted. Why a number is missing is told in `notes`. Cost: O(n).
Extent measure_extent(const TriangleMesh& mesh, const Topology& topology, std::vector<std::string>& notes);

}  // namespace smopt::metrics
