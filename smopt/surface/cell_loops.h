#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "smopt/surface/cube.h"
#include "smopt/surface/face_links.h"

namespace smopt {

/// The closed polygons in which the level set of a trilinear function meets the boundary of its cube. A corner is named by the edge
/// of the cube on which it lies; a loop runs anticlockwise seen from the side of smaller values.
struct CellLoops {
  static constexpr int kMaxLoops = 4;  ///< twelve edges, at least three a loop

  int count = 0;
  std::array<std::uint8_t, kMaxLoops + 1> begin{};  ///< loop i is edges[begin[i]] … edges[begin[i + 1] - 1]
  std::array<std::uint8_t, cube::kEdges> edges{};
  unsigned ambiguous_faces = 0;  ///< bits: faces whose corners alternate in sign
  unsigned joined_faces = 0;     ///< bits: ambiguous faces on which the two inside corners are joined

  [[nodiscard]] std::span<const std::uint8_t> loop(int i) const {
    return {edges.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
};

/// Traces the level set of zero around the cube, face by face as `link_face` says.
/// \param values  field minus isovalue at the corners, finite; a corner is inside where its value is not negative.
CellLoops trace_cell_loops(const cube::CornerValues& values);

}  // namespace smopt
