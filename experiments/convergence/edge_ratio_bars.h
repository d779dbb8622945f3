#pragma once

#include <string>

#include "metrics/histogram.h"

namespace smopt::experiments {

/// A histogram of edge ratios as lines of text, a tenth a line: "0.0–0.1  12.3 %  ████".
/// \pre the number of bins is a multiple of ten, and the histogram is not empty.
std::string edge_ratio_bars(const metrics::Histogram& histogram);

}  // namespace smopt::experiments
