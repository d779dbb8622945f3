#include "baselines/vertex_neighbours.h"

#include "smopt/mesh/stars.h"

namespace smopt::baselines {

VertexNeighbours build_neighbours(const TriangleMesh& mesh) {
  const VertexStars stars = build_stars(mesh);
  VertexNeighbours result;
  result.offsets.reserve(mesh.vertex_count() + 1);
  result.offsets.push_back(0);
  result.neighbours.reserve(3 * mesh.triangle_count());
  std::vector<VertexId> last_row(mesh.vertex_count(), static_cast<VertexId>(mesh.vertex_count()));  // the last row a vertex was put into
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    last_row[v] = v;
    for (const FaceId f : stars[v]) {
      for (const VertexId w : mesh.triangles[f]) {
        if (last_row[w] == v) continue;
        last_row[w] = v;
        result.neighbours.push_back(w);
      }
    }
    result.offsets.push_back(static_cast<std::uint32_t>(result.neighbours.size()));
  }
  result.neighbours.insert(result.neighbours.end(), VertexNeighbours::kSlots, 0);  // a row may be read past its end
  return result;
}

}  // namespace smopt::baselines
