#pragma once

#include "experiments/record.h"

namespace smopt::testing {

/// The record without what differs from run to run: times, memory, and the threads of a solve.
experiments::Json without_times(const experiments::Json& record);

}  // namespace smopt::testing
