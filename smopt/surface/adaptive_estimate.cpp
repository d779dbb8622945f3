#include "smopt/surface/adaptive_estimate.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"
#include "smopt/surface/adaptive_partition.h"
#include "smopt/surface/surface_estimate.h"

namespace smopt {
namespace {

/// Where the trials begin, Å, and how much smaller each error is than the one before.
constexpr double kFirstError = 0.5;
constexpr double kStep = 4;

/// A trial takes at most this part of the limit; the next would take up to four times as much.
constexpr double kLargestTrial = 1.0 / 16;

constexpr double kBytesPerMb = 1 << 20;

/// Of a partition and of the mesh that is made of it: one vertex in three cells that may be crossed, about.
double bytes_of(const GaussianField& field, const AdaptivePartition& partition) {
  const auto& cells = partition.forest.cells();
  const auto crossed = std::ranges::count(cells, true, &CellForest::Cell::may_be_crossed);
  return static_cast<double>(cells.size()) * partition.forest.bytes_per_cell() + bytes_to_mesh(field, 1.5 * static_cast<double>(crossed));
}

}  // namespace

void require_memory_for_partition(const GaussianField& field, double isovalue, double error, std::uint64_t max_memory_bytes) {
  const auto limit = static_cast<double>(max_memory_bytes);
  for (double trial = kFirstError;; trial /= kStep) {
    const double coarse = std::max(trial, error);
    const double bytes = bytes_of(field, partition_space(field, isovalue, coarse));
    const double needed = bytes * coarse / error;
    if (needed <= limit) return;
    if (coarse == error || bytes > kLargestTrial * limit)
      throw InvalidInput(
          fmt::format("at an error of {} Å the surface would need up to {:.0f} MB of memory, more than the limit of {:.0f} MB", error,
                      needed / kBytesPerMb, limit / kBytesPerMb));
  }
}

}  // namespace smopt
