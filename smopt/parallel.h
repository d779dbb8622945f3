#pragma once

#include <cstddef>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

/// Used inside the library; not installed, as it needs TBB.
namespace smopt {

/// Elements a task when little is done for each: some ten microseconds, long beside what starting a task costs.
inline constexpr std::size_t kGrain = 8192;

/// Calls visit(begin, end) for ranges that make up [0, count), on all threads of the calling thread's arena, in any order.
template <class Visit>
void for_ranges_in_parallel(std::size_t count, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) { visit(range.begin(), range.end()); });
}

}  // namespace smopt
