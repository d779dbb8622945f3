#pragma once

#include <array>

#include "smopt/geometry/triangle_intersection.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// What the triangle (a, b, from) covers while its third corner goes to `to` on a straight line: the tetrahedron (a, b, from, to), flat
/// when the move is in the triangle's plane.
struct SweptTriangle {
  Vec3 a, b, from, to;
};

/// Which corner of a triangle is the sweep's a or b; −1 where the triangle does not have it. Sharing is by index, never by coordinates.
struct SharedCorners {
  int a = -1;
  int b = -1;
};

/// Whether a triangle meets the swept tetrahedron elsewhere than in the corners, or the edge ab, that they share. Contact counts.
///
/// The tetrahedron's face (a, b, from) is left out: the triangle is known not to meet it beyond what they share (or already does, and then
/// the pair is not new). Decided exactly, but that contact in a shared corner may count where a, b and the moving corner are collinear at
/// some moment: such moves are refused anyway. Cost: some dozens of orient3d.
bool meets_sweep(const TrianglePoints& triangle, const SharedCorners& shared, const SweptTriangle& sweep);

}  // namespace smopt
