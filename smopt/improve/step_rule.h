#pragma once

#include <span>

#include "smopt/geometry/vec3.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Where a vertex would go before any guard has a say.
enum class StepRule {
  umbrella,           ///< to the mean of its neighbours (Liu et al. 2017, equation 3)
  volume_preserving,  ///< the same without its part along the star's area vector: the enclosed volume does not change
  tangential          ///< the same without its part along the angle-weighted normal
};

/// The displacement that the rule proposes for a vertex at `position` with the given ring, Å. Cost: O(valence).
Vec3 proposed_step(StepRule rule, const Vec3& position, std::span<const VertexId> ring, const std::vector<Vec3>& points);

}  // namespace smopt
