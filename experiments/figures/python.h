#pragma once

#include <string>
#include <vector>

#include "smopt/progress.h"

namespace smopt::experiments {

/// Runs /usr/bin/python3, Debian's, or the Python that the environment variable SMOPT_PYTHON names, to draw figures.
/// \param time_limit_seconds  far above what the figures take: much longer is a Python that hangs.
/// \return what it printed. \throws InvalidInput when there is no such Python, or with what it said when it fails; Cancelled.
std::string run_python(const std::vector<std::string>& arguments, double time_limit_seconds, const ProgressCallback& progress);

}  // namespace smopt::experiments
