#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// An edge of an unbounded grid: the number of its low node, and its axis (0, 1, 2).
struct GridEdge {
  std::array<std::int32_t, 3> node{};
  std::int32_t axis = 0;

  auto operator<=>(const GridEdge&) const = default;
};

/// The part of a surface that one block of space holds. Neighbouring blocks share vertices on the edges of the grid between them.
struct BlockMesh {
  struct SharedVertex {
    GridEdge edge;
    VertexId vertex;  ///< in `points`
  };

  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<SharedVertex> shared;  ///< the vertices that other blocks may have too, each once
};

/// Makes one mesh of blocks: shared vertices on one edge of the grid become one. Vertices and triangles come block after block; a shared
/// vertex is numbered in the first block that has it. The blocks are used up.
/// \pre the points of shared vertices on one edge are the same.
/// \throws InvalidInput when the vertices are more than 32-bit indices can number.
/// Cost: O(n), and O(s·log s) for s shared vertices; all cores, same result for any number of them.
TriangleMesh joined(std::vector<BlockMesh> blocks);

}  // namespace smopt
