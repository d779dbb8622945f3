#include "metrics/solvation/solvable_surface.h"

#include <fmt/format.h>

#include <cmath>

#include "metrics/extent.h"
#include "smopt/error.h"
#include "smopt/mesh/compact.h"
#include "smopt/mesh/components.h"
#include "smopt/mesh/nesting.h"
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

/// Volumes below this part of the area's power 3/2 are rounding; a sphere has 0.094.
constexpr double kLeastVolumeRel = 1e-12;

void require_volume(const TriangleMesh& mesh) {
  const double area = surface_area(mesh);
  if (!(signed_volume(mesh) > kLeastVolumeRel * area * std::sqrt(area))) throw InvalidMesh("the surface encloses no volume");
}

/// Outwards where the nesting depth is even, inwards in a cavity.
void require_components_the_right_way_round(const TriangleMesh& mesh) {
  const Components components = connected_components(mesh);
  if (components.count == 1) return;
  const std::vector<double> volumes = component_volumes(mesh, components);
  const Nesting nesting = component_nesting(mesh, components);
  for (std::size_t c = 0; c < volumes.size(); ++c) {
    const bool is_cavity = nesting.depth[c] % 2 == 1;
    if (is_cavity ? volumes[c] > 0 : volumes[c] < 0)
      throw InvalidMesh(
          fmt::format("component {} ({}, {:.3g} Å³) points {}wards; `smopt improve --rounds 0 --redundant keep --cavities keep` turns it",
                      c, is_cavity ? "a cavity" : "not a cavity", std::abs(volumes[c]), is_cavity ? "out" : "in"));
  }
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
  require_volume(mesh);
  require_components_the_right_way_round(mesh);
  return mesh;
}

}  // namespace

SolvableSurface::SolvableSurface(const TriangleMesh& mesh) : surface(solvable(mesh)), vertices(used_vertices(mesh)) {}

}  // namespace smopt::metrics
