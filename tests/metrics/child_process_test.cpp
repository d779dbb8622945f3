#include "metrics/tetgen/child_process.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace smopt::metrics {
namespace {

/// Its peak memory, MB, as run from a process that holds `ballast_mb` itself.
double peak_of(const std::vector<std::string>& command, std::size_t ballast_mb) {
  const std::vector<char> ballast(ballast_mb << 20, 1);
  return run_process(command, {60, 0}, "test", {}).peak_memory_mb;
}

TEST(ChildProcess, PeakMemoryIsTheProgramsNotItsParents) {
  constexpr double kShell = 50;  // more than a shell needs
  EXPECT_LT(peak_of({"/bin/sh", "-c", "sleep 0.2"}, 400), kShell);
  EXPECT_GT(peak_of({"/bin/sh", "-c", "sleep 0.2"}, 400), 0);
}

TEST(ChildProcess, PeakMemoryCountsWhatTheProgramTakes) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "no python3";
  const double peak = peak_of({"/usr/bin/python3", "-c", "import time; x = b'x' * (200 << 20); del x; time.sleep(0.2)"}, 400);
  EXPECT_GT(peak, 200);
  EXPECT_LT(peak, 300);
}

}  // namespace
}  // namespace smopt::metrics
