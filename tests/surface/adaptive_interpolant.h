#pragma once

#include <functional>

#include "smopt/surface/adaptive_partition.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt::testing {

/// The interpolant in one leaf, at a place in units of the cell.
double interpolant_in_leaf(const AdaptivePartition& partition, CellForest::Id leaf, const Vec3& place);

/// The position of a place in a leaf.
Vec3 position_in_leaf(const AdaptivePartition& partition, CellForest::Id leaf, const Vec3& place);

void for_each_leaf(const AdaptivePartition& partition, const std::function<void(CellForest::Id)>& visit);

/// The interpolant sampled all over the box that holds the surface, at `halvings` below the edge of its finest cells; a piecewise trilinear
/// function is the same on the finer grid. Where no cell is kept the sign is that of the nearest kept one: −1 outside, +1 inside.
ScalarGrid sampled_interpolant(const AdaptivePartition& partition, int halvings);

}  // namespace smopt::testing
