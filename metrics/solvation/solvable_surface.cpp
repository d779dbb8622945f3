#include "metrics/solvation/solvable_surface.h"

#include "smopt/error.h"
#include "smopt/mesh/compact.h"
#include "smopt/mesh/orientation.h"
#include "smopt/mesh/validity.h"

namespace smopt::metrics {
namespace {

void require_solvable(const TriangleMesh& mesh) {
  const ValidityReport report = check_validity(mesh);
  const bool is_solvable = !report.is_empty && !report.nonfinite_vertices.any() && !report.repeated_corners.any() &&
                           !report.boundary_edges.any() && !report.nonmanifold_edges.any() && report.is_oriented();
  if (is_solvable) return;
  if (report.is_empty) throw InvalidMesh("the mesh has no triangle");
  throw InvalidMesh(report.describe());
}

std::vector<VertexId> used_vertices(const TriangleMesh& mesh) {
  std::vector<char> is_used(mesh.vertex_count(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) is_used[v] = 1;
  std::vector<VertexId> used;
  for (VertexId v = 0; v < is_used.size(); ++v)
    if (is_used[v] != 0) used.push_back(v);
  return used;
}

TriangleMesh solvable(TriangleMesh mesh) {
  require_solvable(mesh);
  remove_isolated_vertices(mesh);
  if (signed_volume(mesh) < 0) reverse_orientation(mesh);
  return mesh;
}

}  // namespace

SolvableSurface::SolvableSurface(const TriangleMesh& mesh) : surface(solvable(mesh)), vertices(used_vertices(mesh)) {}

}  // namespace smopt::metrics
