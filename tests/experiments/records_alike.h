#pragma once

#include "experiments/record.h"

namespace smopt::testing {

/// The record without what differs from run to run: times and memory, and the digest of the program.
experiments::Json without_times(const experiments::Json& record);

}  // namespace smopt::testing
