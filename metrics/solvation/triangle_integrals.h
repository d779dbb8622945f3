#pragma once

#include <array>

#include "metrics/solvation/kernels.h"
#include "smopt/geometry/vec3.h"

namespace smopt::metrics {

/// Where the kernels are integrated for.
struct TargetPoint {
  Vec3 position;  ///< Å
  Vec3 normal;    ///< of unit length; 0 where there is none, which makes K3 and K4 0
};

/// How finely triangles are cut before a rule is used on the pieces.
struct TriangleQuadrature {
  /// Pieces are at most this times as long as they are far from the target.
  double largest_piece = 1;
};

/// Each kernel times each corner's linear shape function, integrated over a flat triangle.
using CornerIntegrals = std::array<KernelValues, 3>;

/// How high the surface is above the tangent plane of one corner at another, ångström, for each side; the parabolas that a flat triangle hides. Without
/// them ∂G0/∂n has no integral at a vertex, and errs by the first power of the edge length near it.
struct SideHeights {
  double of_01 = 0, of_12 = 0, of_20 = 0;
};

/// For a target that is not a corner of the triangle; it may be as close as one likes.
///
/// The triangle is halved across its longest side while it is longer than its distance allows; each piece gets the 7-point rule of degree 5 (Radon
/// 1948). Pieces that are still too long after kMostHalvings are left out: that happens only where the target is on the triangle, and what is left of
/// the integral is its principal value.
/// Cost: 7 kernels a piece; the number of pieces grows with the logarithm of length by distance.
CornerIntegrals integrate(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                          const KernelParameters& parameters, const TriangleQuadrature& quadrature);

/// For a target at the triangle's first corner, where ∂G0/∂ν vanishes and the other kernels are weakly singular in the polar coordinates around it
/// (Duffy 1982, SIAM J. Numer. Anal. 19:1260): y = x + s((1 - t)·a + t·b).
CornerIntegrals integrate_at_corner(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                                    const KernelParameters& parameters, const TriangleQuadrature& quadrature);

}  // namespace smopt::metrics
