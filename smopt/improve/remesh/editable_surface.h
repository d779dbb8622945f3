#pragma once

#include <span>
#include <vector>

#include "smopt/improve/guarded_surface.h"
#include "smopt/improve/remesh/patch.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A closed surface whose vertices move and whose triangles are replaced, with all that is known about it: rings, spatial index, normal
/// cones. Vertices and triangles that are not in use keep their numbers until `compacted`: such a vertex has an empty ring.
///
/// Threads may edit it at the same time when each keeps to a region of its own (see `TriangleGrid`).
class EditableSurface {
 public:
  /// No ring grows beyond this, so that each stays where it stands in memory; one that is larger from the start
  /// not beyond its first size.
  static constexpr std::uint32_t kMaxValence = 12;

  /// \throws InvalidMesh when the mesh is not a closed, oriented manifold. Cost: O(n), all cores.
  explicit EditableSurface(const TriangleMesh& mesh);
  EditableSurface(const EditableSurface&) = delete;
  EditableSurface& operator=(const EditableSurface&) = delete;

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const VertexRings& rings() const { return rings_; }
  [[nodiscard]] GuardedSurface& guarded() { return guarded_; }
  [[nodiscard]] const GuardedSurface& guarded() const { return guarded_; }
  [[nodiscard]] const Vec3& point(VertexId v) const { return mesh_.points[v]; }
  [[nodiscard]] std::uint32_t valence(VertexId v) const { return rings_.valence(v); }
  [[nodiscard]] std::uint32_t capacity(VertexId v) const;
  [[nodiscard]] bool is_in_use(VertexId v) const { return rings_.valence(v) > 0; }
  /// Place of w in the ring of v. \pre they are neighbours.
  [[nodiscard]] std::size_t slot_of(VertexId v, VertexId w) const;
  [[nodiscard]] bool are_neighbours(VertexId v, VertexId w) const;
  /// The edge from a vertex to its ring vertex `to`, with its triangles: the left one leads on to the vertex `left`, the right one comes
  /// from `right`.
  struct Edge {
    VertexId to, left, right;
    FaceId left_face, right_face;
  };
  [[nodiscard]] Edge edge_at(VertexId v, std::size_t slot) const {
    const std::span<const VertexId> ring = rings_.vertices(v);
    const std::span<const FaceId> faces = rings_.faces(v);
    const std::size_t next = slot + 1 < ring.size() ? slot + 1 : 0, previous = slot > 0 ? slot - 1 : ring.size() - 1;
    return {ring[slot], ring[next], ring[previous], faces[slot], faces[previous]};
  }
  [[nodiscard]] TriangleMesh compacted() const;

  /// Takes numbers for this many new vertices and twice as many triangles. Not while others are at work.
  struct Spare {
    std::vector<VertexId> vertices;
    std::vector<FaceId> faces;
  };
  Spare reserve(std::size_t vertices);
  /// Where a vertex will be that is not in use yet.
  void place(VertexId unused, const Vec3& point) { mesh_.points[unused] = point; }
  /// Whether every ring has room for what the patch brings.
  [[nodiscard]] bool has_room_for(const Patch& patch) const;
  /// Replaces the patch's old triangles by its new ones. \pre `has_room_for` it, and it is allowed. Cost: O(size of the patch).
  void replace(const Patch& patch);

 private:
  void put_faces(const Patch& patch);
  void edit_ring(const Patch& patch, std::size_t k);
  void set_inner_ring(const Patch& patch);
  void refresh_cone(VertexId v);

  TriangleMesh mesh_;
  VertexRings rings_;
  GuardedSurface guarded_;
  std::vector<char> is_face_used_;
};

}  // namespace smopt
