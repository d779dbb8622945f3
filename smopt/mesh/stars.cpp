#include "smopt/mesh/stars.h"

namespace smopt {

VertexStars build_stars(const TriangleMesh& mesh) {
  VertexStars stars;
  stars.offsets.assign(mesh.vertex_count() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) ++stars.offsets[v + 1];
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) stars.offsets[v + 1] += stars.offsets[v];
  stars.faces.resize(3 * mesh.triangle_count());
  std::vector<std::uint32_t> end(stars.offsets.begin(), stars.offsets.end() - 1);
  for (FaceId f = 0; f < mesh.triangle_count(); ++f)
    for (const VertexId v : mesh.triangles[f]) stars.faces[end[v]++] = f;
  return stars;
}

}  // namespace smopt
