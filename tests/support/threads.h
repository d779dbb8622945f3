#pragma once

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cstddef>

namespace smopt::testing {

/// What `stage` gives for 2, 3 and 8 threads is what it gives for one.
template <class Stage>
void expect_same_for_any_threads(const Stage& stage) {
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return stage();
  };
  const auto one = with_threads(1);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(with_threads(threads) == one) << threads << " threads";
}

}  // namespace smopt::testing
