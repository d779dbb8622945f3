#pragma once

#include <string>

#include "experiments/record.h"

namespace smopt::experiments {

/// What became of a case, in a line: "65258 vertices, 0 intersecting pairs, TetGen p success, pY success; 0.31 s CPU", or its status and reason.
std::string case_line(const Json& record);

}  // namespace smopt::experiments
