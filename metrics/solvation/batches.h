#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <string_view>

#include "smopt/progress.h"

namespace smopt::metrics {

/// Progress is reported so many times a stage.
inline constexpr std::size_t kBatches = 16;

/// Calls work(i) for all i < count on all threads, and reports now and then from the calling one.
template <class Work>
void in_batches(std::size_t count, const ProgressCallback& progress, std::string_view stage, const Work& work) {
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    report_progress(progress, stage, static_cast<double>(batch) / kBatches);
    tbb::parallel_for(count * batch / kBatches, count * (batch + 1) / kBatches, work);
  }
  report_progress(progress, stage, 1);
}

}  // namespace smopt::metrics
