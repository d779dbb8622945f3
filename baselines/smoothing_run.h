#pragma once

#include <optional>

#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// Fills the report of a method that moves every vertex in every round: `vertices` × `rounds` moves, stopped by the rounds, or "diverged at
/// step k" (the rounds go on all the same, as the program that is imitated does).
void report_rounds(MethodReport& report, const TriangleMesh& mesh, int rounds, std::optional<int> diverged_at_step);

}  // namespace smopt::baselines
