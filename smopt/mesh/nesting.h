#pragma once

#include <vector>

#include "smopt/mesh/components.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// How deep each component lies inside others: 0 is outer, odd is a cavity, even is an island in a cavity.
struct Nesting {
  std::vector<std::uint32_t> depth;                   ///< one entry a component
  std::vector<std::vector<std::uint32_t>> enclosing;  ///< the components around each, ascending
};

/// Decides containment exactly: a ray from one point of each component is followed in the direction of +x and its crossings with every
/// other component counted; odd means inside. Orientation plays no part. \pre every component is closed; components that intersect each
/// other are judged by that one point. Cost: O(triangles + crossings), by sorting the rays into a two-dimensional grid.
Nesting component_nesting(const TriangleMesh& mesh, const Components& components);

}  // namespace smopt
