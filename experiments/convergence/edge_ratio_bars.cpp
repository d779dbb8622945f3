#include "experiments/convergence/edge_ratio_bars.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace smopt::experiments {

std::string edge_ratio_bars(const metrics::Histogram& histogram) {
  constexpr std::size_t kLines = 10;
  constexpr double kCharactersPerShare = 150;  // a third of the triangles are fifty characters
  const std::size_t per_line = histogram.counts.size() / kLines;
  const double all = static_cast<double>(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}));
  std::string text;
  for (std::size_t line = 0; line < kLines; ++line) {
    const auto first = histogram.counts.begin() + static_cast<std::ptrdiff_t>(line * per_line);
    const double share = static_cast<double>(std::accumulate(first, first + static_cast<std::ptrdiff_t>(per_line), std::size_t{0})) / all;
    std::string bar;
    for (long i = 0; i < std::lround(share * kCharactersPerShare); ++i) bar += "█";
    text += fmt::format("{:.1f}–{:.1f} {:5.1f} %  {}\n", histogram.edges[line * per_line], histogram.edges[(line + 1) * per_line],
                        100 * share, bar);
  }
  return text;
}

}  // namespace smopt::experiments
