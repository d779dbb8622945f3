#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/page/mesh_view.h"
#include "experiments/record_set.h"
#include "smopt/progress.h"

namespace smopt::experiments {

struct ViewLimits {
  std::size_t shown_triangles = kShownTriangles;
  /// Of all packed meshes together: with its program and data the page stays below 60 MB, which a browser opens within seconds.
  std::size_t packed_bytes = 56'000'000;
};

/// The meshes of a run as the page shows them.
struct RunViews {
  std::vector<std::string> blobs;  ///< packed positions and indices, each once: methods that keep the triangles share them
  /// <molecule>: {radius (Å, null: all is shown), meshes: {<method>: {title, facts of `MeshView`, positions and indices (numbers of blobs)}},
  /// left_out: {<method>: why}}. A molecule without meshes has no entry. "without-cavities" counts as a method.
  nlohmann::ordered_json molecules = nlohmann::ordered_json::object();
};

/// Packs the meshes that the run still has: of all molecules first the initial ones, then method by method in the order of the tables, until
/// `limits.packed_bytes` are used up. A file that cannot be read is left out with the reason. Cost: seconds a mesh at most. \throws Cancelled
RunViews run_views(const RecordSet& records, const std::filesystem::path& directory, const ViewLimits& limits = {},
                   const ProgressCallback& progress = {});

}  // namespace smopt::experiments
