#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics/histogram.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Shortest over longest side of each triangle (Liu et al. 2017: "edge ratio"); dimensionless, 1 for an equilateral triangle, 0 where two
/// corners coincide. Empty where there is no triangle.
struct EdgeRatios {
  std::optional<double> min, mean, median;
  std::optional<double> share_below_01;  ///< of the triangles with a ratio below 0.1
  Histogram histogram;                   ///< 50 bins of 0.02 on [0, 1]
};

/// The angles of the triangles in degrees; 60 for an equilateral triangle. An angle at a corner that coincides with another one is 0.
struct Angles {
  std::optional<double> min, max;
  std::optional<double> mean_min;  ///< mean over the triangles of the smallest angle
  Histogram histogram;             ///< 90 bins of 2° on [0°, 180°]; all three angles of each triangle
  std::optional<double> smallest_below_5, smallest_below_10, smallest_below_20, smallest_below_30;  ///< shares of the triangles
  std::optional<double> largest_above_120, largest_above_150;                                       ///< shares of the triangles
};

struct Shape {
  EdgeRatios edge_ratio;
  Angles angle;
};

/// Measures every triangle with finite corners; how many were left out is told in `notes`. Cost: O(n).
Shape measure_shape(const TriangleMesh& mesh, std::vector<std::string>& notes);

}  // namespace smopt::metrics
