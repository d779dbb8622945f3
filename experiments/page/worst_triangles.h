#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// What a triangle is judged by on the page.
enum class TriangleMeasure { smallest_angle, largest_angle, edge_ratio };

inline constexpr std::array kTriangleMeasures = {TriangleMeasure::smallest_angle, TriangleMeasure::largest_angle,
                                                 TriangleMeasure::edge_ratio};

/// As the page's data call it: "smallest_angle".
std::string_view to_string(TriangleMeasure measure);

/// Angles in degrees, the edge ratio as shortest/longest; not a number where a corner is not finite. Angles are accurate for needles and
/// caps of any thinness.
double measure_triangle(TriangleMeasure measure, const Vec3& a, const Vec3& b, const Vec3& c);

/// A triangle and how it stands among all of its mesh.
struct RankedTriangle {
  FaceId face = 0;
  double value = 0;
  std::size_t rank = 0;  ///< 1: the worst of the mesh; of equal values the one with the smaller id comes first
};

/// The worst of `candidates`, at most `count` of them, worst first: smallest angles and edge ratios, largest angles. Triangles with a corner
/// that is not finite are passed over and take no rank. \param candidates  ids of triangles of the mesh. Cost: O(n log n).
std::vector<RankedTriangle> worst_triangles(const TriangleMesh& mesh, TriangleMeasure measure, std::span<const FaceId> candidates,
                                            std::size_t count);

}  // namespace smopt::experiments
