#pragma once

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// Table 2 of the paper: processor seconds of SMOPT's stages on one thread, beside those of plain Laplacian smoothing of the same mesh.
Table table2(const RecordSet& records);

}  // namespace smopt::experiments
