#include "tests/improve/remesh/sampled_distance.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>

namespace smopt::testing {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

Kernel::Point_3 cgal_point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}

}  // namespace

double distance_from_surface(const Vec3& p, const TriangleMesh& surface) {
  double nearest = HUGE_VAL;
  for (const auto& [a, b, c] : surface.triangles) {
    const Kernel::Triangle_3 t(cgal_point(surface.points[a]), cgal_point(surface.points[b]), cgal_point(surface.points[c]));
    nearest = std::min(nearest, CGAL::squared_distance(cgal_point(p), t));
  }
  return std::sqrt(nearest);
}

double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int n) {
  double farthest = 0;
  for (const auto& [a, b, c] : from.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = (i * from.points[a] + j * from.points[b] + (n - i - j) * from.points[c]) / n;
        farthest = std::max(farthest, distance_from_surface(p, to));
      }
    }
  }
  return farthest;
}

}  // namespace smopt::testing
