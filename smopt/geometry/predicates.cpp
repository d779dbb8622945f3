#include "smopt/geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

namespace smopt {
namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;

Inexact::Point_3 to_point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}
Exact::Point_3 to_exact(const Vec3& p) {
  return {p[0], p[1], p[2]};
}

/// det(b − a, c − a, d − a).
CGAL::Exact_rational determinant(const Exact::Point_3& a, const Exact::Point_3& b, const Exact::Point_3& c, const Exact::Point_3& d) {
  return CGAL::determinant(b - a, c - a, d - a);
}

}  // namespace

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c), to_point(d)));
}

int exact_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  return static_cast<int>(CGAL::orientation(Inexact::Point_2(ax, ay), Inexact::Point_2(bx, by), Inexact::Point_2(cx, cy)));
}

bool touches_sector_on_the_way(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new) {
  const Exact::Point_3 ea = to_exact(a), eb = to_exact(b), ec = to_exact(c), from = to_exact(x), to = to_exact(x_new);
  const CGAL::Exact_rational before = determinant(ea, eb, ec, from);
  const CGAL::Exact_rational after = determinant(ea, eb, ec, to);
  const Exact::Point_3 at = from + (to - from) * (before / (before - after));
  const Exact::Vector_3 da = ea - at, db = eb - at, dc = ec - at;
  const Exact::Vector_3 normal = CGAL::cross_product(da, db);
  if (normal == CGAL::NULL_VECTOR) return true;
  return CGAL::cross_product(da, dc) * normal >= 0 && CGAL::cross_product(dc, db) * normal >= 0;
}

}  // namespace smopt
