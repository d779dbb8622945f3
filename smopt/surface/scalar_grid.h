#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Values at the nodes of a uniform, axis-parallel grid, or of a block of an unbounded one; x runs fastest.
///
/// Node (i, j, k) of the block is node first + (i, j, k) of the unbounded grid, whose node (0, 0, 0) is at `origin`: blocks of one
/// unbounded grid agree in the position of a shared node to the last bit.
struct ScalarGrid {
  std::array<std::uint32_t, 3> size{};  ///< nodes on each axis
  Vec3 origin = Vec3::Zero();           ///< position of the unbounded grid's node (0, 0, 0), ångström
  double spacing = 1;                   ///< ångström
  std::vector<double> values;           ///< size[0]·size[1]·size[2] of them
  std::array<std::int32_t, 3> first{};  ///< number of the block's first node in the unbounded grid

  [[nodiscard]] std::size_t node_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * size[1] + j) * size[0] + i; }
  /// The nodes with number i on an axis all lie in the plane at this coordinate, to the last bit.
  [[nodiscard]] double coordinate(int axis, std::size_t i) const {
    return origin[axis] + spacing * (static_cast<double>(first[axis]) + static_cast<double>(i));
  }
};

}  // namespace smopt
