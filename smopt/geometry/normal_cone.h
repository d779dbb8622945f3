#pragma once

#include <array>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// A direction in which a star of triangles is seen one-to-one; zero where none is known. Single precision: any direction will do, it need
/// not be accurate, only always the same.
using ConeAxis = std::array<float, 3>;

inline bool is_known(const ConeAxis& axis) {
  return axis[0] != 0 || axis[1] != 0 || axis[2] != 0;
}
inline Vec3 to_vector(const ConeAxis& axis) {
  return {axis[0], axis[1], axis[2]};
}

/// A component n · axis of a doubled area vector of edges no longer than L, |axis| ≤ 1, carries a rounding error below 5√3·2⁻⁵³ L²; forty
/// times that is safe and still far below the area of any triangle that can be told from a degenerate one.
inline constexpr double kConeMarginRel = 4e-14;

/// A star at the start and at the end of the move of one of its points (its centre or one on its ring).
struct MovingStar {
  Vec3 center_from, center_to;
  std::vector<Vec3> ring_from, ring_to;  ///< in order, anticlockwise seen from outside
};

/// Finds an axis along which the star projects one-to-one from the start of the move (where a triangle may be exactly degenerate) to its
/// end.
///
/// Every triangle has a component along the axis above the rounding margin at both ends; it is linear in the moving point and so positive
/// all the way. The star then turns around its centre a whole number of times in one direction; that number is one at the end, so it is one
/// all the way, and the projection is one-to-one: triangles of the star meet nowhere but in what they share. Returns the zero axis when the
/// mean normal is not such an axis. Cost: O(valence).
ConeAxis find_cone_axis(const MovingStar& star);

}  // namespace smopt
