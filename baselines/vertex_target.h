#pragma once

#include <optional>
#include <vector>

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The options by which a method that changes the number of vertices is told how many to aim at: `vertices` and `match`.
std::vector<MethodOption> vertex_target_options();

/// The number of vertices to aim at: what `vertices` says, or as many as the triangles of the mesh in the file that `match` names use;
/// nothing when neither is given. \pre `values` has the options of `vertex_target_options`. \throws InvalidOption when both are given, or
/// when there are fewer than a closed surface has; InvalidInput when the file cannot be read.
std::optional<std::size_t> vertex_target(const OptionValues& values);

}  // namespace smopt::baselines
