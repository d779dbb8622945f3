#include "experiments/page/worst_triangles.h"

#include <algorithm>
#include <cmath>

#include "smopt/geometry/triangle_shape.h"

namespace smopt::experiments {
namespace {

/// atan2 of sine and cosine: accurate for needles and caps, where an arc cosine is not.
double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b) {
  return kDegrees * std::atan2(doubled_area_vector(at, a, b).norm(), (a - at).dot(b - at));
}

std::array<double, 3> angles_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {angle_deg(a, b, c), angle_deg(b, c, a), angle_deg(c, a, b)};
}

bool is_finite(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.allFinite() && b.allFinite() && c.allFinite();
}

/// Sorts the worst to the front, whichever way the measure goes.
double badness(TriangleMeasure measure, double value) {
  return measure == TriangleMeasure::largest_angle ? value : -value;
}

struct JudgedTriangle {
  double badness = 0;
  FaceId face = 0;
};

std::vector<JudgedTriangle> worst_first(const TriangleMesh& mesh, TriangleMeasure measure) {
  std::vector<JudgedTriangle> judged;
  judged.reserve(mesh.triangle_count());
  for (FaceId face = 0; face < mesh.triangle_count(); ++face) {
    const Triangle& t = mesh.triangles[face];
    const double value = measure_triangle(measure, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    if (!std::isnan(value)) judged.push_back({badness(measure, value), face});
  }
  std::sort(judged.begin(), judged.end(), [](const JudgedTriangle& a, const JudgedTriangle& b) {
    return a.badness != b.badness ? a.badness > b.badness : a.face < b.face;
  });
  return judged;
}

}  // namespace

std::string_view to_string(TriangleMeasure measure) {
  switch (measure) {
    case TriangleMeasure::smallest_angle:
      return "smallest_angle";
    case TriangleMeasure::largest_angle:
      return "largest_angle";
    case TriangleMeasure::edge_ratio:
      break;
  }
  return "edge_ratio";
}

double measure_triangle(TriangleMeasure measure, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!is_finite(a, b, c)) return std::nan("");
  switch (measure) {
    case TriangleMeasure::smallest_angle:
      return std::ranges::min(angles_deg(a, b, c));
    case TriangleMeasure::largest_angle:
      return std::ranges::max(angles_deg(a, b, c));
    case TriangleMeasure::edge_ratio:
      break;
  }
  return shape_of(a, b, c).edge_ratio;
}

std::vector<RankedTriangle> worst_triangles(const TriangleMesh& mesh, TriangleMeasure measure, std::span<const FaceId> candidates,
                                            std::size_t count) {
  std::vector<bool> is_candidate(mesh.triangle_count(), false);
  for (const FaceId face : candidates) is_candidate[face] = true;
  std::vector<RankedTriangle> worst;
  std::size_t rank = 0;
  for (const JudgedTriangle& triangle : worst_first(mesh, measure)) {
    if (worst.size() == count) break;
    ++rank;
    if (is_candidate[triangle.face]) worst.push_back({triangle.face, std::abs(triangle.badness), rank});
  }
  return worst;
}

}  // namespace smopt::experiments
