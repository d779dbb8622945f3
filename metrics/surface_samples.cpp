#include "metrics/surface_samples.h"

#include <cmath>

#include "metrics/extent.h"

namespace smopt::metrics {
namespace {

/// Steps of the two-dimensional R₂ sequence: 1/ρ and 1/ρ² for the real root ρ of x³ = x + 1 (Roberts 2018); spreads evenly for any count.
constexpr double kR2StepU = 0.7548776662466927;
constexpr double kR2StepV = 0.5698402909980532;

double triangle_area(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
}

/// The `k`-th point of a sequence that fills a triangle evenly.
Vec3 point_in_triangle(const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
  double ignored = 0;
  const double u = std::sqrt(std::modf((static_cast<double>(k) + 0.5) * kR2StepU, &ignored));
  const double v = std::modf((static_cast<double>(k) + 0.5) * kR2StepV, &ignored);
  return (1 - u) * mesh.points[t[0]] + u * (1 - v) * mesh.points[t[1]] + u * v * mesh.points[t[2]];
}

}  // namespace

std::vector<Vec3> sample_surface(const TriangleMesh& mesh, std::size_t count) {
  const double area = surface_area(mesh);
  if (!std::isfinite(area) || area <= 0) return {};
  const double step = area / static_cast<double>(count);
  std::vector<Vec3> samples;
  samples.reserve(count);
  std::size_t f = 0;
  double area_up_to_f = triangle_area(mesh, mesh.triangles[0]);
  for (std::size_t k = 0; k < count; ++k) {
    const double target = (static_cast<double>(k) + 0.5) * step;
    while (area_up_to_f < target && f + 1 < mesh.triangle_count()) area_up_to_f += triangle_area(mesh, mesh.triangles[++f]);
    samples.push_back(point_in_triangle(mesh, mesh.triangles[f], k));
  }
  return samples;
}

}  // namespace smopt::metrics
