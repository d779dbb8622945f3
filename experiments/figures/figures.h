#pragma once

#include <filesystem>

#include "experiments/record_set.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// Draws the paper's figures 5 (area and volume), 6 (edge ratios) and 7 (angles), and one of all methods (smallest angle, share below 30°,
/// distance to the level set, intersecting pairs, time), from `directory`/records into `directory`/figures, as SVG and PNG, by Python and matplotlib. The Python is /usr/bin/python3, Debian's, or the one that the environment variable SMOPT_PYTHON
/// names. \param records  those of `directory`; they give the order of molecules and methods. \throws InvalidInput with what Python said;
/// when matplotlib is missing it names the package. Cancelled.
void draw_figures(const RecordSet& records, const std::filesystem::path& directory, const ProgressCallback& progress = {});

}  // namespace smopt::experiments
