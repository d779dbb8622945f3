#pragma once

#include "metrics/solvation/far_field.h"
#include "metrics/solvation/triangle_integrals.h"

namespace smopt::metrics {

/// How the integrals over the surface are taken.
struct SurfaceSums {
  FarFieldOptions far;            ///< for pairs of vertices that are summed as points
  double reach = 3;               ///< pairs nearer than this times the source's longest edge are integrated over triangles
  TriangleQuadrature quadrature;  ///< for those
};

/// For an asked relative accuracy of the polar energy, in [1e-5, 0.1]: what the sums may change of the energy that exact integration over the mesh's
/// triangles would give. What remains is the mesh's own error, several times as much on molecules.
///
/// Point sums err like the cube of edge length by distance. TABLE
/// \param is_direct  all pairs that are not close are summed one by one.
/// \throws InvalidOption for an accuracy out of its range.
SurfaceSums surface_sums_for(double accuracy, double kappa, bool is_direct);

}  // namespace smopt::metrics
