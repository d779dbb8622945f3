#pragma once

#include "smopt/io/molecule.h"
#include "smopt/progress.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt {

/// The parameters of the kernel sum and its sampling.
struct GaussianGridOptions {
  double decay = 0.6;        ///< d of the kernel, 1/Å²; > 0
  double spacing = 0.745;    ///< edge of the grid's cubes, Å; > 0
  double least_term = 1e-6;  ///< a kernel's value below which it may be left out; in (0, 1)
};

/// Samples φ(x) = Σ exp(-d(|x - x_i|² - r_i²)) (Liu et al. 2017, equations 1 and 2) on a uniform grid around the molecule.
///
/// The kernel is separable: three one-dimensional exponentials an atom, then products. The box holds every point where a term is not
/// below `least_term`, so the field is zero on its outermost nodes.
/// \throws InvalidInput for a molecule without atoms, a negative or non-finite radius or coordinate, a radius for which the kernel
/// overflows, or a grid of more than 2³¹ nodes.
/// \throws InvalidOption for an option out of its range.
/// Cost: O(atoms × kernel support + grid nodes); eight bytes a node.
ScalarGrid gaussian_grid(const Molecule& molecule, const GaussianGridOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt
