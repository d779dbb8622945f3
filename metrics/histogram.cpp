#include "metrics/histogram.h"

#include <algorithm>

namespace smopt::metrics {

Histogram::Histogram(double low, double high, std::size_t bins) : counts(bins, 0) {
  for (std::size_t i = 0; i <= bins; ++i) edges.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(bins));
}

void Histogram::add(double x) {
  const double position = (x - edges.front()) / (edges.back() - edges.front()) * static_cast<double>(counts.size());
  const auto last = counts.size() - 1;
  auto bin = static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(last)));
  if (bin > 0 && x < edges[bin]) --bin;  // the division was rounded across an edge
  if (bin < last && x >= edges[bin + 1]) ++bin;
  ++counts[bin];
}

}  // namespace smopt::metrics
