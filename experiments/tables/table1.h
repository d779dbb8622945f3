#pragma once

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Table 1 of the paper: sizes of the initial and the improved meshes, and whether AFMPB and TetGen succeed on them.
Table table1(const RecordSet& records);

}  // namespace smopt::experiments
