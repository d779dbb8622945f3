#pragma once

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Every case in a row, molecule by molecule: all methods under the same judge, and how each ended.
Table methods_table(const RecordSet& records);

}  // namespace smopt::experiments
