#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

struct DistanceOptions {
  std::size_t samples = 200'000;  ///< points spread evenly over each surface; the standard error of the mean falls as 1/√samples or faster
};

/// Distances (Å) from points of one surface to the nearest point of another.
struct OneSidedDistance {
  double max = 0;   ///< over the samples and the vertices: a lower bound of the true maximum
  double mean = 0;  ///< over the samples, so weighted by area
  double rms = 0;   ///< over the samples
};

struct SurfaceDistance {
  OneSidedDistance to_reference;    ///< from the mesh to the reference
  OneSidedDistance from_reference;  ///< from the reference to the mesh
  double hausdorff = 0;             ///< the larger of the two maxima
  std::size_t samples = 0;          ///< on each surface
};

/// Distance between two surfaces, from both sides, by nearest-point queries in CGAL's AABB tree. Samples are the same for the same mesh (a
/// low-discrepancy sequence, stratified by area), so the result is reproducible and independent of the number of threads.
/// Empty when one of them has a corner that is not finite or no triangle with an area; `notes` says which.
/// Cost: O((samples + vertices) log n).
std::optional<SurfaceDistance> surface_distance(const TriangleMesh& mesh, const TriangleMesh& reference, std::vector<std::string>& notes,
                                                const DistanceOptions& options = {});

}  // namespace smopt::metrics
