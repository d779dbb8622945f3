#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

/// To and from CGAL's `Surface_mesh`, over any kernel. Templates, so that no header of the project includes CGAL's.
namespace smopt::baselines {

/// Whether a surface may have borders.
enum class Borders { allowed, rejected };

/// \throws InvalidMesh that says what is wrong where unless the mesh is an oriented manifold of finite coordinates (and closed, with
/// `Borders::rejected`). Cost: O(n) for a mesh that is.
void require_surface(const TriangleMesh& mesh, Borders borders);

/// Vertices and triangles keep their numbers, and triangles their first corner. \pre `require_surface` passes the mesh. Cost: O(n).
template <class Surface>
Surface to_surface(const TriangleMesh& mesh) {
  using Point = typename Surface::Point;
  using Vertex = typename Surface::Vertex_index;
  Surface surface;
  const auto vertices = static_cast<typename Surface::size_type>(mesh.vertex_count());
  const auto triangles = static_cast<typename Surface::size_type>(mesh.triangle_count());
  surface.reserve(vertices, vertices + triangles, triangles);  // about as many edges as Euler's formula says
  for (const Vec3& p : mesh.points) surface.add_vertex(Point(p.x(), p.y(), p.z()));
  for (const auto& [a, b, c] : mesh.triangles) surface.add_face(Vertex(a), Vertex(b), Vertex(c));
  return surface;
}

/// The positions alone, for a method that leaves the triangles as they are. \pre as many vertices as points.
template <class Surface>
void copy_points(const Surface& surface, std::vector<Vec3>& points) {
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    points[v] = Vec3(p.x(), p.y(), p.z());
  }
}

/// The inverse of `to_surface`. \pre a surface of triangles; CGAL's removed elements have been collected (`collect_garbage`).
template <class Surface>
TriangleMesh from_surface(const Surface& surface) {
  TriangleMesh mesh;
  mesh.points.resize(surface.number_of_vertices());
  copy_points(surface, mesh.points);
  mesh.triangles.reserve(surface.number_of_faces());
  for (const auto f : surface.faces()) {
    const auto first = surface.halfedge(f), second = surface.next(first), third = surface.next(second);
    mesh.triangles.push_back({surface.target(first), surface.target(second), surface.target(third)});
  }
  return mesh;
}

}  // namespace smopt::baselines
