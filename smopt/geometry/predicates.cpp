#include "smopt/geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>

namespace smopt {
namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Bounds = CGAL::Simple_cartesian<CGAL::Interval_nt<false>>;

Inexact::Point_3 to_point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}

/// The question of `touches_sector_on_the_way`, in the arithmetic of a kernel; "yes" also where the three points a, b and x(t) are
/// collinear.
template <class Kernel>
CGAL::Uncertain<bool> touches_sector(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new) {
  using Point = typename Kernel::Point_3;
  using Vector = typename Kernel::Vector_3;
  const Point pa(a[0], a[1], a[2]), pb(b[0], b[1], b[2]), pc(c[0], c[1], c[2]), from(x[0], x[1], x[2]), to(x_new[0], x_new[1], x_new[2]);
  const auto before = CGAL::determinant(pb - pa, pc - pa, from - pa);
  const auto after = CGAL::determinant(pb - pa, pc - pa, to - pa);
  const Point at = from + (to - from) * (before / (before - after));
  const Vector da = pa - at, db = pb - at, dc = pc - at;
  const Vector normal = CGAL::cross_product(da, db);
  // c is outside the sector exactly when it lies beyond one of its two sides; with a zero normal neither product is negative.
  return !((CGAL::cross_product(da, dc) * normal < 0) | (CGAL::cross_product(dc, db) * normal < 0));
}

}  // namespace

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c), to_point(d)));
}

int exact_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  return static_cast<int>(CGAL::orientation(Inexact::Point_2(ax, ay), Inexact::Point_2(bx, by), Inexact::Point_2(cx, cy)));
}

bool touches_sector_on_the_way(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new) {
  {
    const CGAL::Interval_nt<false>::Protector rounds_upwards;
    const CGAL::Uncertain<bool> touches = touches_sector<Bounds>(a, b, c, x, x_new);
    if (CGAL::is_certain(touches)) return CGAL::get_certain(touches);
  }
  return CGAL::get_certain(touches_sector<Exact>(a, b, c, x, x_new));
}

}  // namespace smopt
