#include "smopt/mesh/rings.h"

namespace smopt {

bool append_ring(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, std::vector<VertexId>& vertices,
                 std::vector<FaceId>& faces) {
  const std::size_t valence = star.size();
  if (valence < 3) return false;
  const std::size_t start = vertices.size();
  const auto next_vertex = [&](FaceId f) { return mesh.triangles[f][(corner_of(mesh.triangles[f], v) + 1) % 3]; };
  const auto previous_vertex = [&](FaceId f) { return mesh.triangles[f][(corner_of(mesh.triangles[f], v) + 2) % 3]; };
  FaceId f = star[0];
  for (std::size_t i = 0; i < valence; ++i) {
    vertices.push_back(next_vertex(f));
    faces.push_back(f);
    const VertexId outgoing = previous_vertex(f);
    std::size_t continuations = 0;
    FaceId following = f;
    for (const FaceId g : star) {
      if (next_vertex(g) != outgoing) continue;
      following = g;
      ++continuations;
    }
    const bool is_closing = following == star[0];
    if (continuations != 1 || is_closing != (i + 1 == valence)) {
      vertices.resize(start);
      faces.resize(start);
      return false;
    }
    f = following;
  }
  return true;
}

std::optional<VertexRings> build_rings(const TriangleMesh& mesh) {
  const VertexStars stars = build_stars(mesh);
  VertexRings rings;
  rings.ring_vertices.reserve(stars.faces.size());
  rings.ring_faces.reserve(stars.faces.size());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!stars[v].empty() && !append_ring(mesh, v, stars[v], rings.ring_vertices, rings.ring_faces)) return std::nullopt;
  rings.offsets = stars.offsets;
  return rings;
}

}  // namespace smopt
