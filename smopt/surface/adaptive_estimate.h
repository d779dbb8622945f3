#pragma once

#include <cstdint>

#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// Refuses an adaptive surface that would need more memory than the limit, before it is made.
///
/// The memory is that of the partition and the mesh, measured at errors four times smaller and smaller from half an ångström on, and taken to go
/// with 1/error from there (an upper bound: cells of a size are enough for a range of errors); partitions are tried as long as they are small
/// beside the limit.
/// \throws InvalidInput saying how much it would need.
/// Cost: that of the partitions it tries.
void require_memory_for_partition(const GaussianField& field, double isovalue, double error, std::uint64_t max_memory_bytes);

}  // namespace smopt
