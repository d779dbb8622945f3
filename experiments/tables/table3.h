#pragma once

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Table 3 of the paper: vertices and intersecting pairs of triangles, initial and by each method.
Table table3(const RecordSet& records);

}  // namespace smopt::experiments
