#pragma once

#include "smopt/progress.h"
#include "smopt/surface/cell_forest.h"
#include "smopt/surface/cell_sampler.h"
#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// A partition of space into cubes, fine where the surface φ = c asks for it.
struct AdaptivePartition {
  CellLattice lattice;
  CellForest forest;
};

/// Why cells were divided.
struct AdaptivePartitionReport {
  std::size_t for_error = 0;     ///< the interpolant's surface could have been farther than the error from φ = c
  std::size_t for_balance = 0;   ///< neighbours were smaller by more than one halving
  std::size_t for_hanging = 0;   ///< the values they hand to smaller neighbours were too far off
  std::size_t for_topology = 0;  ///< several loops or an ambiguous face beside smaller cells
};

/// Divides cubes until the surface of the continuous piecewise trilinear interpolant lies within `error` of φ = c (the first stage of
/// TMSmesh 2.0; Liu et al. 2017, section 0.1).
///
/// Cubes start with an edge of 1.2/√d: a kernel's width is 0.7/√d. A cube is judged by its 27 samples (at half its edge). It stays as it is
/// - when φ = c cannot pass: every sample is farther from c than the interpolant's error; or
/// - when the interpolant's error over the least slope of φ, both from the samples, is at most `error`, and along one axis both φ and the
///   interpolant are monotone, so that their surfaces are single-valued along it; or
/// - where φ may be flat (near its critical points), when its diagonal is at most `error`: a cube whose corners have both signs holds a point
///   of φ = c.
/// Then cubes are divided until those that share a face or an edge differ by one halving at most; until the values that hanging nodes get
/// from a coarser neighbour keep the bound; and until no cube beside smaller ones has an ambiguous face or several loops, so that what is in
/// it is a disc.
/// \throws InvalidInput when the field's box has too many cells of the finest size for 32-bit numbers, or they cannot be resolved there.
/// \throws InvalidOption for an error that is not positive and finite.
/// Cost: O(cells) samplings of 27 to 125 nodes; memory for cells near the surface. All cores, same result for any number of them.
AdaptivePartition partition_space(const GaussianField& field, double isovalue, double error, AdaptivePartitionReport* report = nullptr,
                                  const ProgressCallback& progress = {});

}  // namespace smopt
