#pragma once

#include <tbb/global_control.h>

#include <cstddef>

namespace smopt::bench {

/// So many threads for everything until the end of the scope.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::int64_t threads) : control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}

 private:
  tbb::global_control control_;
};

}  // namespace smopt::bench
