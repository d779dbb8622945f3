#include "smopt/geometry/swept_triangle.h"

#include "smopt/geometry/predicates.h"

namespace smopt {
namespace {

/// Against a side face (corner, from, to), of which the triangle may have the corner.
bool meets_side(const TrianglePoints& triangle, int shared, const Vec3& corner, const SweptTriangle& sweep) {
  const TrianglePoints side{corner, sweep.from, sweep.to};
  return shared < 0 ? triangles_meet(triangle, side) : triangles_meet_beyond_vertex(starting_at(triangle, shared), side);
}

/// Against the face (a, b, to) where the move ends.
bool meets_end(const TrianglePoints& triangle, const SharedCorners& shared, const SweptTriangle& sweep) {
  if (shared.a >= 0 && shared.b >= 0)
    return triangles_meet_beyond_edge({triangle[shared.a], triangle[shared.b], triangle[3 - shared.a - shared.b]},
                                      {sweep.a, sweep.b, sweep.to});
  if (shared.a >= 0) return triangles_meet_beyond_vertex(starting_at(triangle, shared.a), {sweep.a, sweep.b, sweep.to});
  if (shared.b >= 0) return triangles_meet_beyond_vertex(starting_at(triangle, shared.b), {sweep.b, sweep.to, sweep.a});
  return triangles_meet(triangle, {sweep.a, sweep.b, sweep.to});
}

/// Whether the triangle's plane has the whole sweep strictly on one side but for what is shared.
bool is_beside_triangle(const TrianglePoints& t, const SharedCorners& shared, const SweptTriangle& sweep) {
  const int side = orient3d(t[0], t[1], t[2], sweep.from);
  return side != 0 && orient3d(t[0], t[1], t[2], sweep.to) == side && (shared.a >= 0 || orient3d(t[0], t[1], t[2], sweep.a) == side) &&
         (shared.b >= 0 || orient3d(t[0], t[1], t[2], sweep.b) == side);
}

/// Whether the plane of the face (p, q, r), which has all shared corners, has the fourth corner on one side (or on it) and the triangle
/// strictly on the other but for what is shared.
bool is_beyond_face(const TrianglePoints& t, const SharedCorners& shared, const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& fourth) {
  int outside = -orient3d(p, q, r, fourth);
  for (int i = 0; i < 3; ++i) {
    if (i == shared.a || i == shared.b) continue;
    const int side = orient3d(p, q, r, t[i]);
    if (side == 0 || side == -outside) return false;
    outside = side;
  }
  return true;
}

/// Quick exact proofs that there is no contact: a plane of one of the two has the other strictly beyond it.
bool is_apart(const TrianglePoints& t, const SharedCorners& shared, const SweptTriangle& s) {
  if (is_beside_triangle(t, shared, s)) return true;
  if (is_beyond_face(t, shared, s.a, s.b, s.to, s.from) || is_beyond_face(t, shared, s.a, s.b, s.from, s.to)) return true;
  if (shared.b < 0 && is_beyond_face(t, shared, s.a, s.from, s.to, s.b)) return true;
  return shared.a < 0 && is_beyond_face(t, shared, s.b, s.from, s.to, s.a);
}

}  // namespace

bool meets_sweep(const TrianglePoints& triangle, const SharedCorners& shared, const SweptTriangle& sweep) {
  if (is_apart(triangle, shared, sweep)) return false;
  if (meets_end(triangle, shared, sweep)) return true;
  if (meets_side(triangle, shared.a, sweep.a, sweep) || meets_side(triangle, shared.b, sweep.b, sweep)) return true;
  for (int i = 0; i < 3; ++i) {
    if (i == shared.a || i == shared.b) continue;
    if (strictly_inside_tetrahedron(triangle[i], sweep.a, sweep.b, sweep.from, sweep.to)) return true;
  }
  return false;
}

}  // namespace smopt
