#pragma once

#include <optional>

#include "smopt/surface/adaptive_partition.h"

namespace smopt::experiments {

/// The continuous, piecewise trilinear interpolant of φ − c that the mesher follows, at a point; nothing where the partition keeps no cell
/// (there the surface is not near). Cost: that of finding the cell.
std::optional<double> interpolant_at(const AdaptivePartition& partition, const Vec3& x);

}  // namespace smopt::experiments
