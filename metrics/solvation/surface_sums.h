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

inline constexpr double kBestAccuracy = 1e-4;
inline constexpr double kWorstAccuracy = 0.1;

/// For an asked accuracy, relative to the polar energy: by how much it may change when the sums are made finer still. The mesh's own error comes on top, a
/// per cent or more for a molecule at an edge length of half an ångström; within it, and of second order too, is what sums over points differ from
/// integrals over flat triangles by, at any reach (1e-3 on a sphere of 642 vertices).
///
/// The reach grows with the cube root. Measured on fas2 (an initial mesh of 5 800 vertices, improved ones of 5 800 and 11 900, against 1e-4), the largest
/// change of the energy:
///
///   accuracy   0.1    0.03   0.01   3e-3   1e-3   3e-4
///   reach      0.67   1.0    1.4    2.2    3.1    4.6
///   measured   7e-3   4e-3   1e-3   2e-3   8e-4   2e-4
///
/// and on spheres of 642 vertices and more too. On coarser ones points, which are on the sphere, are nearer to it than triangles, and sums over either differ
/// by more than 3e-3. The tree's tolerance is the accuracy itself, which changes the energy by a twentieth of it. The rules on the triangles are the same
/// for all: what they err of the solid angle, 1e-4 at most, the known integral of the double layer takes away again.
/// \param is_direct  all pairs that are not close are summed one by one.
/// \throws InvalidOption for an accuracy out of [kBestAccuracy, kWorstAccuracy].
SurfaceSums surface_sums_for(double accuracy, double kappa, bool is_direct);

}  // namespace smopt::metrics
