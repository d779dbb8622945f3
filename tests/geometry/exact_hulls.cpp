#include "tests/geometry/exact_hulls.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <vector>

namespace smopt::testing {
namespace {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Points = std::vector<Point>;

Point exact(const Vec3& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}

Points exact(std::span<const Vec3> points) {
  Points result;
  for (const Vec3& p : points) result.push_back(exact(p));
  return result;
}

Rational height(const Vector& normal, const Point& p) {
  return normal.x() * p.x() + normal.y() * p.y() + normal.z() * p.z();
}

Rational determinant(const Point& a, const Point& b, const Point& c, const Point& d) {
  return CGAL::cross_product(b - a, c - a) * (d - a);
}

bool is_zero(const Vector& v) {
  return v == CGAL::NULL_VECTOR;
}

int sign(const Rational& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

/// All p with normal · p ≤ offset.
struct HalfSpace {
  Vector normal;
  Rational offset;

  [[nodiscard]] bool contains(const Point& p) const { return height(normal, p) <= offset; }
};

/// Normals among which (with either sign) are those of all half-spaces that the hull of the points is the intersection of. More than those
/// do no harm: a half-space that just holds all points holds their hull.
std::vector<Vector> bounding_normals(const Points& points) {
  const Point& o = points.front();
  Vector direction = CGAL::NULL_VECTOR, normal = CGAL::NULL_VECTOR;
  for (const Point& p : points)
    if (is_zero(direction)) direction = p - o;
  for (const Point& p : points)
    if (is_zero(normal)) normal = CGAL::cross_product(direction, p - o);
  if (is_zero(direction)) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (is_zero(normal)) {
    const Vector across = CGAL::cross_product(direction, direction.x() != 0 ? Vector(0, 1, 0) : Vector(1, 0, 0));
    const Vector side = is_zero(across) ? CGAL::cross_product(direction, Vector(0, 0, 1)) : across;
    return {direction, side, CGAL::cross_product(direction, side)};
  }
  const bool is_flat = std::all_of(points.begin(), points.end(), [&](const Point& p) { return normal * (p - o) == 0; });
  std::vector<Vector> normals;
  if (is_flat) normals.push_back(normal);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (is_flat) normals.push_back(CGAL::cross_product(points[j] - points[i], normal));
      for (std::size_t k = j + 1; k < points.size() && !is_flat; ++k)
        normals.push_back(CGAL::cross_product(points[j] - points[i], points[k] - points[i]));
    }
  return normals;
}

std::vector<HalfSpace> half_spaces(const Points& points) {
  std::vector<HalfSpace> result;
  for (const Vector& n : bounding_normals(points)) {
    if (is_zero(n)) continue;
    Rational low = height(n, points.front()), high = low;
    for (const Point& p : points) {
      low = std::min(low, height(n, p));
      high = std::max(high, height(n, p));
    }
    result.push_back({n, high});
    result.push_back({-n, -low});
  }
  return result;
}

/// The part of a convex polygon (its corners in order; a segment or a point is one too) in a half-space: Sutherland and Hodgman 1974.
Points clipped(const Points& polygon, const HalfSpace& half) {
  std::vector<Rational> heights;
  for (const Point& p : polygon) heights.push_back(height(half.normal, p) - half.offset);
  if (std::all_of(heights.begin(), heights.end(), [](const Rational& h) { return h <= 0; })) return polygon;
  Points result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    const Point &p = polygon[i], &q = polygon[next];
    const Rational &hp = heights[i], &hq = heights[next];
    if (hp <= 0) result.push_back(p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) result.push_back(p + (hp / (hp - hq)) * (q - p));
  }
  return result;
}

/// Whether an axis-aligned box of the one lies apart from that of the other: nothing is rounded.
bool are_boxes_apart(std::span<const Vec3> p, std::span<const Vec3> q) {
  for (int i = 0; i < 3; ++i) {
    const auto less = [i](const Vec3& u, const Vec3& v) { return u[i] < v[i]; };
    const auto [p_low, p_high] = std::minmax_element(p.begin(), p.end(), less);
    const auto [q_low, q_high] = std::minmax_element(q.begin(), q.end(), less);
    if ((*p_high)[i] < (*q_low)[i] || (*q_high)[i] < (*p_low)[i]) return true;
  }
  return false;
}

}  // namespace

int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return sign(determinant(exact(a), exact(b), exact(c), exact(d)));
}

int rational_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const Rational x(ax), y(ay);
  return sign((Rational(bx) - x) * (Rational(cy) - y) - (Rational(by) - y) * (Rational(cx) - x));
}

bool are_rationally_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return is_zero(CGAL::cross_product(exact(b) - exact(a), exact(c) - exact(a)));
}

bool hulls_meet_beyond(std::span<const Vec3> p, std::span<const Vec3> q, std::span<const Vec3> shared) {
  if (are_boxes_apart(p, q)) return false;
  Points common = exact(p);
  for (const HalfSpace& half : half_spaces(exact(q))) {
    common = clipped(common, half);
    if (common.empty()) return false;
  }
  if (shared.empty()) return true;
  const std::vector<HalfSpace> allowed = half_spaces(exact(shared));
  return std::any_of(common.begin(), common.end(), [&](const Point& corner) {
    return std::any_of(allowed.begin(), allowed.end(), [&](const HalfSpace& half) { return !half.contains(corner); });
  });
}

bool cgal_triangles_meet(std::span<const Vec3, 3> p, std::span<const Vec3, 3> q) {
  return CGAL::do_intersect(Kernel::Triangle_3(exact(p[0]), exact(p[1]), exact(p[2])),
                            Kernel::Triangle_3(exact(q[0]), exact(q[1]), exact(q[2])));
}

bool sector_is_touched(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new) {
  const Rational before = determinant(exact(a), exact(b), exact(c), exact(x));
  const Rational after = determinant(exact(a), exact(b), exact(c), exact(x_new));
  const Point apex = exact(x) + (before / (before - after)) * (exact(x_new) - exact(x));
  const Vector to_a = exact(a) - apex, to_b = exact(b) - apex, to_c = exact(c) - apex;
  const Vector normal = CGAL::cross_product(to_a, to_b);
  return is_zero(normal) || (normal * CGAL::cross_product(to_a, to_c) >= 0 && normal * CGAL::cross_product(to_c, to_b) >= 0);
}

}  // namespace smopt::testing
