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
#include "metrics/surface_samples.h"

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

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
  const std::vector<double> at_samples = distances(sample_surface(from, samples), to);
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
