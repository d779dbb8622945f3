#pragma once

#include <cstddef>
#include <vector>

namespace smopt::metrics {

/// Counts in equal bins. Bin i holds edges[i] ≤ x < edges[i + 1], the last one its upper edge too; values outside belong to the nearest
/// bin.
struct Histogram {
  std::vector<double> edges;        ///< one more than there are bins
  std::vector<std::size_t> counts;  ///< one a bin

  Histogram() = default;
  Histogram(double low, double high, std::size_t bins);
  void add(double x);
};

}  // namespace smopt::metrics
