#include "baselines/vertex_neighbours.h"

#include <algorithm>

#include "smopt/mesh/stars.h"

namespace smopt::baselines {

VertexNeighbours build_neighbours(const TriangleMesh& mesh) {
  const VertexStars stars = build_stars(mesh);
  VertexNeighbours result;
  result.offsets.reserve(mesh.vertex_count() + 1);
  result.offsets.push_back(0);
  result.neighbours.reserve(3 * mesh.triangle_count());
  std::vector<VertexId> row;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    row.clear();
    for (const FaceId f : stars[v]) {
      for (const VertexId w : mesh.triangles[f]) {
        if (w != v) row.push_back(w);
      }
    }
    std::sort(row.begin(), row.end());
    result.neighbours.insert(result.neighbours.end(), row.begin(), std::unique(row.begin(), row.end()));
    result.offsets.push_back(static_cast<std::uint32_t>(result.neighbours.size()));
  }
  return result;
}

}  // namespace smopt::baselines
