#pragma once

#include <vector>

#include "smopt/improve/remesh/remesh_state.h"
#include "smopt/improve/remesh/surface_worker.h"

namespace smopt {

/// Holds the surface against the goals, and says around the worst place of each that is missed what was refused and why. Cost: O(n), all cores.
std::vector<GoalOutcome> check_goals(const RemeshState& state, SurfaceWorker& worker);

/// Whether a triangle or an edge of the star of v misses a goal.
bool has_bad_shape(const RemeshState& state, VertexId v);

/// The same, or the valence of v does.
bool misses_a_goal(const RemeshState& state, VertexId v);

}  // namespace smopt
