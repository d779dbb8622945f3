#include "smopt/improve/guarded_surface.h"

#include "smopt/parallel.h"

namespace smopt {
namespace {

using Directions = std::vector<Eigen::Vector3f>;

/// Of the triangles' normals, as `reliable_direction`.
Directions normal_directions(const TriangleMesh& mesh) {
  Directions directions(mesh.triangle_count());
  for_ranges_in_parallel(directions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& t = mesh.triangles[f];
      directions[f] = reliable_direction(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    }
  });
  return directions;
}

std::vector<NormalCone> normal_cones(const TriangleMesh& mesh, const VertexRings& rings) {
  const Directions directions = normal_directions(mesh);
  std::vector<NormalCone> cones(mesh.vertex_count());
  for_ranges_in_parallel(cones.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3> ring;
    Directions of_star;
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      ring.clear();
      of_star.clear();
      for (const VertexId w : rings.vertices(v)) ring.push_back(mesh.points[w]);
      for (const FaceId f : rings.faces(v)) of_star.push_back(directions[f]);
      if (!ring.empty()) cones[v] = find_resting_cone(mesh.points[v], ring, of_star);
    }
  });
  return cones;
}

}  // namespace

GuardedSurface::GuardedSurface(TriangleMesh& surface_mesh, const VertexRings& mesh_rings)
    : mesh(surface_mesh),
      rings(mesh_rings),
      grid(surface_mesh.points, surface_mesh.triangles),
      cones(normal_cones(surface_mesh, mesh_rings)) {}

}  // namespace smopt
