#pragma once

#include "smopt/geometry/vec3.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// How far the farthest point of one surface is from another, between two bounds, Å.
struct FarthestPoint {
  double lower = 0;           ///< `point` is at least so far
  double upper = 0;           ///< no point of the surface is farther: proved, but for rounding (1e-13 of the extent)
  Vec3 point = Vec3::Zero();  ///< on the one surface
};

/// The Hausdorff distance of two surfaces and its two sides.
struct TwoSidedDistance {
  FarthestPoint from_a;  ///< of a from b
  FarthestPoint from_b;  ///< of b from a

  [[nodiscard]] double lower() const { return from_a.lower > from_b.lower ? from_a.lower : from_b.lower; }
  [[nodiscard]] double upper() const { return from_a.upper > from_b.upper ? from_a.upper : from_b.upper; }
};

/// The two-sided distance of two surfaces to a tolerance, by branch and bound.
///
/// The lower bound is the distance of a vertex or of another point that was tried. The upper bound is the largest over pieces of the triangles
/// of the smallest distance within which a piece is of one triangle of the other surface (convex, so largest at its corners); a piece is split
/// until that is at most the tolerance above the lower bound. In the manner of Guthe, Borodin and Klein (Fast and accurate Hausdorff distance
/// calculation between meshes, WSCG 2005), with pieces cut along the borders of what lies over one triangle. The surface is what the triangles
/// are: points without a triangle do not count, degenerate triangles do. Any surface is infinitely far from an empty one, and an
/// empty one at 0 from any.
/// \param tolerance  upper − lower at most, Å, on each side; > 0 and finite, otherwise throws InvalidOption; not less than 5e-13 of
///                   the extent. Where a triangle would have to be split into more than 20 000 pieces, the bounds stay farther apart
/// \pre   coordinates of triangles are finite, otherwise throws InvalidMesh.
/// Cost: O(n log n), all cores, same result for any number of them; 0.3 to 1.3 s of processor time for two
/// surfaces of 130 000 triangles at a thousandth of an edge, the less the farther apart they are.
TwoSidedDistance two_sided_distance(const TriangleMesh& a, const TriangleMesh& b, double tolerance);

}  // namespace smopt
