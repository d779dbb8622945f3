#include "smopt/mesh/compact.h"

#include <cassert>

namespace smopt {

void keep_triangles(TriangleMesh& mesh, const std::vector<char>& is_kept) {
  assert(is_kept.size() == mesh.triangle_count());
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangle_count(); ++f)
    if (is_kept[f] != 0) mesh.triangles[kept++] = mesh.triangles[f];
  mesh.triangles.resize(kept);
}

std::size_t remove_isolated_vertices(TriangleMesh& mesh) {
  std::vector<VertexId> new_id(mesh.vertex_count(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) new_id[v] = 1;
  VertexId kept = 0;
  for (VertexId v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == 0) continue;
    mesh.points[kept] = mesh.points[v];
    new_id[v] = kept++;
  }
  const std::size_t removed = mesh.vertex_count() - kept;
  mesh.points.resize(kept);
  for (Triangle& t : mesh.triangles) t = {new_id[t[0]], new_id[t[1]], new_id[t[2]]};
  return removed;
}

}  // namespace smopt
