#include "smopt/geometry/swept_triangle.h"

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

}  // namespace

bool meets_sweep(const TrianglePoints& triangle, const SharedCorners& shared, const SweptTriangle& sweep) {
  if (meets_end(triangle, shared, sweep)) return true;
  if (meets_side(triangle, shared.a, sweep.a, sweep) || meets_side(triangle, shared.b, sweep.b, sweep)) return true;
  for (int i = 0; i < 3; ++i) {
    if (i == shared.a || i == shared.b) continue;
    if (strictly_inside_tetrahedron(triangle[i], sweep.a, sweep.b, sweep.from, sweep.to)) return true;
  }
  return false;
}

}  // namespace smopt
