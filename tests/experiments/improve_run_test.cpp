#include "experiments/improve_run.h"

#include <gtest/gtest.h>

#include <vector>

#include "experiments/machine.h"
#include "smopt/peak_memory.h"

namespace smopt::experiments {
namespace {

#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory

TEST(PeakMemory, CountsWhatWasTakenSinceItWasReset) {
  reset_peak_memory();
  const double before = peak_memory_mb();
  ASSERT_GT(before, 0);
  { const std::vector<char> taken(std::size_t{300} << 20, 1); }
  EXPECT_NEAR(peak_memory_mb() - before, 300, 10);
  reset_peak_memory();
  EXPECT_LT(peak_memory_mb() - before, 50);
}

#endif

}  // namespace
}  // namespace smopt::experiments
