#include "metrics/degenerate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact_point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

std::vector<bool> degenerate_triangles(const TriangleMesh& mesh) {
  std::vector<bool> degenerate;
  degenerate.reserve(mesh.triangle_count());
  for (const Triangle& t : mesh.triangles)
    degenerate.push_back(has_finite_corners(mesh, t) &&
                         CGAL::collinear(exact_point(mesh.points[t[0]]), exact_point(mesh.points[t[1]]), exact_point(mesh.points[t[2]])));
  return degenerate;
}

}  // namespace smopt::metrics
