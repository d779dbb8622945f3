#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// Where the way from x along the gradient of φ first comes to φ = c: close to the nearest point of the level set where x is near it.
///
/// Newton's method on φ along its gradient, each step at most a third of a kernel's width.
/// \return nothing when it does not arrive (near critical points of φ, or far from the surface).
/// Cost: about five evaluations of φ.
std::optional<Vec3> foot_on_level_set(const GaussianField& field, double isovalue, const Vec3& x);

/// How far points are from φ = c, as the length of the straight line to their foot: an upper bound of the distance, and near the surface
/// the same to second order.
struct LevelSetDistance {
  double largest = 0;          ///< Å
  double mean = 0;             ///< Å
  std::size_t unresolved = 0;  ///< points without a foot; not in the other numbers
};

/// Cost: that of `foot_on_level_set` a point; all cores, same result for any number of them.
LevelSetDistance distance_to_level_set(const GaussianField& field, double isovalue, const std::vector<Vec3>& points);

}  // namespace smopt
