#pragma once

#include <optional>
#include <span>
#include <vector>

#include "smopt/mesh/stars.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The one-ring of each vertex of a closed, oriented manifold, in order around it: triangle `faces(v)[i]` has the corners v,
/// `vertices(v)[i]` and `vertices(v)[i + 1]` (cyclic), anticlockwise seen from outside.
struct VertexRings {
  /// Where a vertex's ring stands in the two arrays below.
  struct Row {
    std::uint32_t begin = 0;
    std::uint32_t valence = 0;
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> rows;                ///< one a vertex
  std::vector<VertexId> ring_vertices;  ///< 3 × triangle_count entries as built; more where rings have room to grow
  std::vector<FaceId> ring_faces;       ///< the same

  [[nodiscard]] std::size_t vertex_count() const { return rows.size(); }
  [[nodiscard]] std::uint32_t valence(VertexId v) const { return rows[v].valence; }
  [[nodiscard]] std::span<const VertexId> vertices(VertexId v) const { return {ring_vertices.data() + rows[v].begin, rows[v].valence}; }
  [[nodiscard]] std::span<const FaceId> faces(VertexId v) const { return {ring_faces.data() + rows[v].begin, rows[v].valence}; }
};

/// Orders the triangles of one star into a single cycle. Appends to `vertices` and `faces`; false (nothing appended) where they form none:
/// an open fan, several fans, an edge with other than two triangles, triangles that disagree in orientation, or fewer than three triangles.
bool append_ring(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, std::vector<VertexId>& vertices,
                 std::vector<FaceId>& faces);

/// Whether every vertex that has triangles has a ring. \pre stars are the mesh's. Cost: O(n), on all threads.
bool has_all_rings(const TriangleMesh& mesh, const VertexStars& stars);

/// The rings of the whole mesh, or nothing when some vertex that has triangles has no ring: the mesh is then not a closed, oriented
/// manifold. Vertices without triangles get an empty ring. Cost: O(n), on all threads.
std::optional<VertexRings> build_rings(const TriangleMesh& mesh);

}  // namespace smopt
