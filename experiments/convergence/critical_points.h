#pragma once

#include <span>
#include <vector>

#include "experiments/convergence/topology_changes.h"
#include "smopt/surface/cell_sampler.h"
#include "smopt/surface/gaussian_field.h"

namespace smopt::experiments {

/// A point where φ is flat: as the isovalue passes its value, the level set changes its topology there.
struct CriticalPoint {
  Vec3 position = Vec3::Zero();    ///< ångström
  double value = 0;                ///< φ
  Vec3 curvatures = Vec3::Zero();  ///< eigenvalues of the matrix of second derivatives, ascending, 1/Å²

  /// Directions in which φ falls: 0 at a minimum, 1 and 2 at saddles, 3 at a maximum.
  [[nodiscard]] int index() const { return static_cast<int>((curvatures.array() < 0).count()); }
  [[nodiscard]] double largest_curvature() const { return curvatures.cwiseAbs().maxCoeff(); }
  /// What the level set's Euler characteristic gains when the point comes to lie inside (the isovalue falls below the point's value): a
  /// maximum is a new sphere, a saddle of index 2 joins two parts of the inside, one of index 1 fills a hole, a minimum fills a pocket.
  [[nodiscard]] int gain_when_inside() const { return index() % 2 == 1 ? 2 : -2; }
};

/// The critical points of φ in the given cubes of level 0 and those that touch them, by Newton's method on ∇φ = 0 from a grid of seeds.
///
/// A seed whose first step is long is passed over: other seeds are nearer to where it leads. A critical point that is nearly degenerate
/// (an eigenvalue near zero) may be missed.
/// \return ascending by |φ − isovalue|; no two nearer than `kSamePoint`. Cost: some hundred evaluations of φ's derivatives a cube; all
/// cores, same result for any number of them.
std::vector<CriticalPoint> critical_points_near(const GaussianField& field, double isovalue, const CellLattice& lattice,
                                                std::span<const LatticeCell> cells);

/// Ångström. Newton's method stops at steps of 1e-6 Å, where what the field leaves out (1e-6 of φ) makes its gradient jump.
inline constexpr double kSamePoint = 1e-3;

}  // namespace smopt::experiments
