#pragma once

#include <filesystem>

#include "smopt/progress.h"

namespace smopt::experiments {

/// Draws `directory`/ablation.json (see `figure_data`) into `directory`/figures: one at a time, main effects, interactions, thresholds, as SVG and
/// PNG, by the Python that `draw_figures` uses. \throws InvalidInput with what Python said; Cancelled.
void draw_ablation_figures(const std::filesystem::path& directory, const ProgressCallback& progress = {});

}  // namespace smopt::experiments
