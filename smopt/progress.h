#pragma once

#include <functional>
#include <string_view>

#include "smopt/error.h"

namespace smopt {

/// Called now and then by long-running functions: the stage's name and the fraction of it that is done, in [0, 1]. Returning false cancels.
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/// Reports to `progress` if there is one; throws Cancelled when it returns false.
inline void report_progress(const ProgressCallback& progress, std::string_view stage, double fraction) {
  if (progress && !progress(stage, fraction)) throw Cancelled();
}

}  // namespace smopt
