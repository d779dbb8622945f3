#include "metrics/distance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "metrics/degenerate.h"
#include "metrics/extent.h"
#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

/// Steps of the two-dimensional R₂ sequence: 1/ρ and 1/ρ² for the real root ρ of x³ = x + 1 (Roberts 2018); spreads evenly for any count.
constexpr double kR2StepU = 0.7548776662466927;
constexpr double kR2StepV = 0.5698402909980532;

Kernel::Point_3 to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Nearest-point queries; degenerate triangles are left out (their neighbours cover them, and they have no plane).
class NearestPoint {
 public:
  explicit NearestPoint(const TriangleMesh& mesh) : triangles_(proper_triangles(mesh)), tree_(triangles_.begin(), triangles_.end()) {
    tree_.build();
    tree_.accelerate_distance_queries();
  }

  [[nodiscard]] double distance(const Vec3& p) const { return std::sqrt(tree_.squared_distance(to_cgal(p))); }

 private:
  static Triangles proper_triangles(const TriangleMesh& mesh) {
    const std::vector<bool> degenerate = degenerate_triangles(mesh);
    Triangles triangles;
    for (std::size_t f = 0; f < mesh.triangle_count(); ++f) {
      const auto& [a, b, c] = mesh.triangles[f];
      if (!degenerate[f]) triangles.emplace_back(to_cgal(mesh.points[a]), to_cgal(mesh.points[b]), to_cgal(mesh.points[c]));
    }
    return triangles;
  }

  Triangles triangles_;
  Tree tree_;
};

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

/// `count` points, each standing for an equal part of the area, in the order of the triangles.
std::vector<Vec3> sample_by_area(const TriangleMesh& mesh, std::size_t count) {
  const double step = surface_area(mesh) / static_cast<double>(count);
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

std::vector<Vec3> vertices_in_use(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertex_count(), false);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) used[v] = true;
  std::vector<Vec3> vertices;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (used[v]) vertices.push_back(mesh.points[v]);
  return vertices;
}

std::vector<double> distances(const std::vector<Vec3>& points, const NearestPoint& surface) {
  std::vector<double> result(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { result[i] = surface.distance(points[i]); });
  return result;
}

OneSidedDistance one_sided(const TriangleMesh& from, const NearestPoint& to, std::size_t samples) {
  const std::vector<double> at_samples = distances(sample_by_area(from, samples), to);
  const std::vector<double> at_vertices = distances(vertices_in_use(from), to);
  OneSidedDistance result;
  for (const double d : at_samples) {
    result.max = std::max(result.max, d);
    result.mean += d;
    result.rms += d * d;
  }
  for (const double d : at_vertices) result.max = std::max(result.max, d);
  result.mean /= static_cast<double>(samples);
  result.rms = std::sqrt(result.rms / static_cast<double>(samples));
  return result;
}

/// Empty when `mesh` has something to measure from and to.
std::string why_not_measurable(const TriangleMesh& mesh) {
  if (!has_finite_triangles(mesh)) return "has a triangle with a corner that is not finite";
  if (!(surface_area(mesh) > 0)) return "has no triangle with an area";
  return {};
}

}  // namespace

std::optional<SurfaceDistance> surface_distance(const TriangleMesh& mesh, const TriangleMesh& reference, std::vector<std::string>& notes,
                                                const DistanceOptions& options) {
  const std::string mesh_fault = why_not_measurable(mesh);
  const std::string reference_fault = why_not_measurable(reference);
  if (!mesh_fault.empty()) notes.push_back("distance: the mesh " + mesh_fault);
  if (!reference_fault.empty()) notes.push_back("distance: the reference " + reference_fault);
  if (!mesh_fault.empty() || !reference_fault.empty()) return std::nullopt;

  const std::size_t samples = std::max<std::size_t>(options.samples, 1);
  SurfaceDistance result;
  result.to_reference = one_sided(mesh, NearestPoint(reference), samples);
  result.from_reference = one_sided(reference, NearestPoint(mesh), samples);
  result.hausdorff = std::max(result.to_reference.max, result.from_reference.max);
  result.samples = samples;
  return result;
}

}  // namespace smopt::metrics
