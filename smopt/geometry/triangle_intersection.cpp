#include "smopt/geometry/triangle_intersection.h"

#include <algorithm>

#include "smopt/geometry/predicates.h"

namespace smopt {
namespace {

/// Whether p, collinear with a and b, lies between them.
bool is_between(const Vec3& p, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (p[i] < std::min(a[i], b[i]) || p[i] > std::max(a[i], b[i])) return false;
  return true;
}

/// Segments in one plane that projects one-to-one along `axis`.
bool coplanar_segments_meet(int axis, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int abc = orient2d_along(axis, a, b, c), abd = orient2d_along(axis, a, b, d);
  const int cda = orient2d_along(axis, c, d, a), cdb = orient2d_along(axis, c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_between(c, a, b)) || (abd == 0 && is_between(d, a, b)) || (cda == 0 && is_between(a, c, d)) ||
         (cdb == 0 && is_between(b, c, d));
}

/// The two corners of a collinear triangle that span it.
std::pair<Vec3, Vec3> span_of_collinear(const TrianglePoints& t) {
  for (int i = 0; i < 3; ++i)
    if (is_between(t[i], t[(i + 1) % 3], t[(i + 2) % 3])) return {t[(i + 1) % 3], t[(i + 2) % 3]};
  return {t[0], t[1]};
}

bool coplanar_point_in_triangle(int axis, const Vec3& p, const TrianglePoints& t) {
  const int s0 = orient2d_along(axis, t[0], t[1], p), s1 = orient2d_along(axis, t[1], t[2], p), s2 = orient2d_along(axis, t[2], t[0], p);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool coplanar_segment_meets_triangle(int axis, const Vec3& a, const Vec3& b, const TrianglePoints& t) {
  return coplanar_point_in_triangle(axis, a, t) || coplanar_segments_meet(axis, a, b, t[0], t[1]) ||
         coplanar_segments_meet(axis, a, b, t[1], t[2]) || coplanar_segments_meet(axis, a, b, t[2], t[0]);
}

/// Whether u and v lie in the same direction from the apex (neither at it).
bool are_on_one_ray(const Vec3& apex, const Vec3& u, const Vec3& v) {
  return are_collinear(apex, u, v) && !is_between(apex, u, v);
}

/// Whether the segment from t[0] to p has more than t[0] in common with the triangle.
bool segment_enters_triangle(const Vec3& p, const TrianglePoints& t) {
  const int axis = projection_axis(t[0], t[1], t[2]);
  if (axis < 0) return are_on_one_ray(t[0], p, t[1]) || are_on_one_ray(t[0], p, t[2]);
  if (p == t[0] || orient3d(t[0], t[1], t[2], p) != 0) return false;
  const int side = orient2d_along(axis, t[0], t[1], t[2]);
  return orient2d_along(axis, t[0], t[1], p) * side >= 0 && orient2d_along(axis, t[0], p, t[2]) * side >= 0;
}

/// Two collinear triangles with the shared edge p[0]p[1] = q[0]q[1]: both go on beyond the same end of it.
bool collinear_triangles_meet_beyond_edge(const TrianglePoints& p, const TrianglePoints& q) {
  const auto go_on_beyond = [&](const Vec3& end, const Vec3& other) {
    return is_between(end, other, p[2]) && is_between(end, other, q[2]) && are_on_one_ray(end, p[2], q[2]);
  };
  return go_on_beyond(p[0], p[1]) || go_on_beyond(p[1], p[0]);
}

}  // namespace

TrianglePoints starting_at(const TrianglePoints& t, int first) {
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

bool segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (orient3d(a, b, c, d) != 0) return false;
  for (const auto& [p, q, r] : {TrianglePoints{a, b, c}, TrianglePoints{a, b, d}, TrianglePoints{c, d, a}, TrianglePoints{c, d, b}}) {
    const int axis = projection_axis(p, q, r);
    if (axis >= 0) return coplanar_segments_meet(axis, a, b, c, d);
  }
  return is_between(a, c, d) || is_between(b, c, d) || is_between(c, a, b);  // all four on one line
}

bool segment_meets_triangle(const Vec3& a, const Vec3& b, const TrianglePoints& t) {
  const int side_a = orient3d(t[0], t[1], t[2], a), side_b = orient3d(t[0], t[1], t[2], b);
  if (side_a * side_b > 0) return false;
  if (side_a == 0 && side_b == 0) {
    const int axis = projection_axis(t[0], t[1], t[2]);
    if (axis >= 0) return coplanar_segment_meets_triangle(axis, a, b, t);
    const auto [c, d] = span_of_collinear(t);
    return segments_meet(a, b, c, d);
  }
  const int s0 = orient3d(a, b, t[0], t[1]), s1 = orient3d(a, b, t[1], t[2]), s2 = orient3d(a, b, t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool triangles_meet(const TrianglePoints& p, const TrianglePoints& q) {
  for (int i = 0; i < 3; ++i) {
    if (segment_meets_triangle(p[i], p[(i + 1) % 3], q)) return true;
    if (segment_meets_triangle(q[i], q[(i + 1) % 3], p)) return true;
  }
  return false;
}

bool triangles_meet_beyond_vertex(const TrianglePoints& p, const TrianglePoints& q) {
  if (!segment_meets_triangle(p[1], p[2], q) && !segment_meets_triangle(q[1], q[2], p)) return false;
  // The opposite side of a collinear triangle may hold the shared corner itself.
  if (are_collinear(p[0], p[1], p[2])) return segment_enters_triangle(p[1], q) || segment_enters_triangle(p[2], q);
  if (are_collinear(q[0], q[1], q[2])) return segment_enters_triangle(q[1], p) || segment_enters_triangle(q[2], p);
  return true;
}

bool triangles_meet_beyond_edge(const TrianglePoints& p, const TrianglePoints& q) {
  if (orient3d(p[0], p[1], p[2], q[2]) != 0) return false;
  const int axis = projection_axis(p[0], p[1], p[2]);
  if (axis < 0) return are_collinear(q[0], q[1], q[2]) && collinear_triangles_meet_beyond_edge(p, q);
  return orient2d_along(axis, p[0], p[1], p[2]) == orient2d_along(axis, p[0], p[1], q[2]);
}

bool triangles_meet_beyond_shared(const TrianglePoints& p, const std::array<std::uint32_t, 3>& p_ids, const TrianglePoints& q,
                                  const std::array<std::uint32_t, 3>& q_ids) {
  std::array<int, 3> in_p{}, in_q{};
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (p_ids[i] != q_ids[j]) continue;
      in_p[shared] = i;
      in_q[shared++] = j;
      break;
    }
  }
  switch (shared) {
    case 0:
      return triangles_meet(p, q);
    case 1:
      return triangles_meet_beyond_vertex(starting_at(p, in_p[0]), starting_at(q, in_q[0]));
    case 2:
      return triangles_meet_beyond_edge({p[in_p[0]], p[in_p[1]], p[3 - in_p[0] - in_p[1]]},
                                        {q[in_q[0]], q[in_q[1]], q[3 - in_q[0] - in_q[1]]});
    default:
      return true;
  }
}

bool strictly_inside_tetrahedron(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int side = orient3d(a, b, c, d);
  return side != 0 && orient3d(a, b, c, point) == side && orient3d(a, d, b, point) == side && orient3d(b, d, c, point) == side &&
         orient3d(c, d, a, point) == side;
}

}  // namespace smopt
