#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "smopt/geometry/vec3.h"
#include "smopt/surface/cube.h"

namespace smopt {

/// What the signs at a cube's corners alone tell about the level set in it, where they tell all: there is one loop, and no face is ambiguous.
/// More than nine cells in ten that a molecule's surface crosses are of this kind.
struct PlainCell {
  std::uint8_t count = 0;  ///< corners of the loop; 0 for other signs
  std::array<std::uint8_t, cube::kEdges> edges{};

  [[nodiscard]] std::span<const std::uint8_t> loop() const { return {edges.data(), count}; }
};

/// For each pattern of signs (bit i: corner i is inside) the loop that `trace_cell_loops` finds.
const std::array<PlainCell, 256>& plain_cells();

/// The corner of a loop from which the fan of triangles has the least area, the first of equal ones.
/// \param corners  at least three.
std::size_t best_fan_apex(std::span<const Vec3> corners);

}  // namespace smopt
