#pragma once

#include <span>

#include "smopt/geometry/vec3.h"

/// Decisions with rational numbers, written from the definitions and without the library's predicates, so that they can judge them. Slow:
/// tens of microseconds each.
namespace smopt::testing {

/// Sign of det(b − a, c − a, d − a), and of the area of the plane triangle abc.
int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int rational_orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Whether three points lie on one line or coincide.
bool are_rationally_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the convex hull of `p` (one to three points) and that of `q` (any number but zero, in any position) have a point in common that
/// is not in the convex hull of `shared` (which may be empty).
bool hulls_meet_beyond(std::span<const Vec3> p, std::span<const Vec3> q, std::span<const Vec3> shared);

/// The same decision by CGAL's intersection test, for two triangles that are not degenerate: a check of the oracle itself.
bool cgal_triangles_meet(std::span<const Vec3, 3> p, std::span<const Vec3, 3> q);

/// Whether, at the moment when x moving to x_new is coplanar with a, b and c, c lies in the closed angle a–x–b or that angle is degenerate.
bool sector_is_touched(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, const Vec3& x_new);

}  // namespace smopt::testing
