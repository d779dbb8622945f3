#pragma once

#include <array>
#include <span>

#include "smopt/improve/remesh/remesh_state.h"

namespace smopt {

/// The step of v to the centroid of its star, by area: edges become alike (Botsch and Kobbelt 2004).
Vec3 step_to_centroid(const EditableSurface& surface, VertexId v);

/// Steps that may better the worst triangles around v: to the mean of its ring, and to where the triangles would be equilateral, the worse ones
/// counting more.
std::array<Vec3, 2> steps_to_better_angles(const RemeshState& state, VertexId v);

}  // namespace smopt
