#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// A triangle of a cell's patch: indices into the patch's points.
using PatchTriangle = std::array<std::uint8_t, 3>;

/// Whether no two of the triangles meet elsewhere than in a shared corner or a shared edge (exact), and two on one edge run along it
/// in opposite directions, so that no edge has three. No triangle may be degenerate.
/// Cost: quadratic in the number of triangles.
bool is_embedded(std::span<const Vec3> points, std::span<const PatchTriangle> triangles);

}  // namespace smopt
