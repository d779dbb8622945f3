#include "smopt/mesh/compact.h"

#include <atomic>
#include <cassert>

#include "smopt/parallel.h"

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
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      for (const VertexId v : mesh.triangles[f]) std::atomic_ref(new_id[v]).store(1, std::memory_order_relaxed);
  });
  VertexId kept = 0;
  for (VertexId v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == 0) continue;
    if (kept != v) mesh.points[kept] = mesh.points[v];
    new_id[v] = kept++;
  }
  const std::size_t removed = mesh.vertex_count() - kept;
  if (removed == 0) return 0;
  mesh.points.resize(kept);
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      for (VertexId& v : mesh.triangles[f]) v = new_id[v];
  });
  return removed;
}

}  // namespace smopt
