#pragma once

#include <cstddef>
#include <cstdint>

#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Decimals of lengths in ångström: the least errors are some hundredths.
inline constexpr int kDistanceDecimals = 4;

inline Cell counted(std::size_t n) {
  return static_cast<long>(n);
}

inline Cell counted(std::int64_t n) {
  return static_cast<long>(n);
}

}  // namespace smopt::experiments
