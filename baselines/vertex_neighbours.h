#pragma once

#include <span>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// The neighbours of each vertex of any triangle mesh, each once, as one flat array (compressed rows): what `meshconn` of ISO2mesh gives.
struct VertexNeighbours {
  std::vector<std::uint32_t> offsets;  ///< vertex_count + 1 entries
  std::vector<VertexId> neighbours;    ///< within a row in the order in which the vertex's triangles name them

  [[nodiscard]] std::size_t vertex_count() const { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const VertexId> operator[](std::size_t v) const {
    return {neighbours.data() + offsets[v], neighbours.data() + offsets[v + 1]};
  }
};

/// A vertex without triangles has no neighbours. Cost: O(n).
VertexNeighbours build_neighbours(const TriangleMesh& mesh);

/// The mean of the neighbours' values. \pre v has neighbours.
inline Vec3 neighbour_mean(std::span<const VertexId> neighbours, const std::vector<Vec3>& values) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId w : neighbours) sum += values[w];
  return sum * (1 / static_cast<double>(static_cast<VertexId>(neighbours.size())));  // one division, of what fits 32 bits: half the time
}

}  // namespace smopt::baselines
