#pragma once

#include <cmath>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Exact decisions of CGAL's kernel, used where the filters below cannot decide (in the .cpp, so that CGAL's headers stay there).
int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int exact_orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Error bound of the determinant below relative to its permanent: Shewchuk 1997, (7 + 56ε)ε with ε = 2⁻⁵³, rounded up.
inline constexpr double kOrient3dErrorRel = 8e-16;
/// The same for two dimensions, (3 + 16ε)ε.
inline constexpr double kOrient2dErrorRel = 3.4e-16;
/// Determinants below this may have suffered underflow and are decided exactly.
inline constexpr double kUnderflowGuard = 1e-280;

/// Sign of det(b − a, c − a, d − a): +1 when d lies on the side of the plane abc to which (b − a) × (c − a) points, 0 exactly on it.
/// Always exact; cost: 20 flops where the filter decides.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  const double bycz = by * cz, bzcy = bz * cy, bzcx = bz * cx, bxcz = bx * cz, bxcy = bx * cy, bycx = by * cx;
  const double det = (bycz - bzcy) * dx + (bzcx - bxcz) * dy + (bxcy - bycx) * dz;
  const double permanent = (std::abs(bycz) + std::abs(bzcy)) * std::abs(dx) + (std::abs(bzcx) + std::abs(bxcz)) * std::abs(dy) +
                           (std::abs(bxcy) + std::abs(bycx)) * std::abs(dz);
  const double bound = kOrient3dErrorRel * permanent + kUnderflowGuard;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exact_orient3d(a, b, c, d);
}

/// Sign of the area of the plane triangle abc: +1 anticlockwise, 0 exactly collinear.
inline int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (bx - ax) * (cy - ay);
  const double right = (by - ay) * (cx - ax);
  const double bound = kOrient2dErrorRel * (std::abs(left) + std::abs(right)) + kUnderflowGuard;
  const double det = left - right;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exact_orient2d(ax, ay, bx, by, cx, cy);
}

/// orient2d of the projection along coordinate axis `axis` (0: on the yz plane, 1: zx, 2: xy).
inline int orient2d_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return orient2d(a[u], a[v], b[u], b[v], c[u], c[v]);
}

/// The axis along which the triangle abc projects to a triangle of non-zero area, or −1 when its corners are exactly collinear.
inline int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2d_along(axis, a, b, c) != 0) return axis;
  return -1;
}

/// Whether the three points lie exactly on one line (or coincide).
inline bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return projection_axis(a, b, c) < 0;
}

/// Whether the ring vertices a, b, c and the moving point x(t) = x + t (x_new − x), at the moment t in [0, 1] when the four are coplanar,
/// show c within the closed angle a–x(t)–b (or a, b and x(t) collinear): decided with rational numbers. \pre orient3d(a, b, c, x) and
/// orient3d(a, b, c, x_new) are not both of the same sign, and not both zero.
bool touches_sector_on_the_way(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new);

}  // namespace smopt
