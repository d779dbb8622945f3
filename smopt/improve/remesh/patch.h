#pragma once

#include <cstddef>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

inline constexpr VertexId kNoVertex = 0xFFFFFFFF;

/// A triangle and the point from which, or to which, it sweeps.
struct SweptTetrahedron {
  Triangle base;
  VertexId apex;
};

/// A disc of a surface and the triangles that would take its place: what every operation that changes connectivity is, as far as what is
/// allowed and what is stored are concerned. One is used again and again, so that nothing is allocated.
struct Patch {
  std::vector<VertexId> boundary;       ///< anticlockwise seen from outside; the same for old and new triangles
  std::vector<FaceId> old_faces;        ///< all that goes
  std::vector<Triangle> new_triangles;  ///< all that comes, anticlockwise
  std::vector<FaceId> new_faces;        ///< their numbers: old faces', and ones that were not in use
  std::vector<SweptTetrahedron> swept;  ///< together what lies between old and new triangles
  std::vector<Triangle> walls;          ///< between two of these
  VertexId removed = kNoVertex;         ///< the vertex inside of the old triangles, if there is one
  VertexId added = kNoVertex;           ///< the vertex inside of the new triangles, if there is one; the mesh has its point already
  Vec3 center = Vec3::Zero();           ///< what is swept lies in the tetrahedra of the boundary's edges with this point, Å,
  Vec3 target = Vec3::Zero();           ///< and with this one, Å

  void clear() {
    boundary.clear();
    old_faces.clear();
    new_triangles.clear();
    new_faces.clear();
    swept.clear();
    walls.clear();
    removed = added = kNoVertex;
  }
  [[nodiscard]] std::size_t next(std::size_t k) const { return k + 1 < boundary.size() ? k + 1 : 0; }
  [[nodiscard]] std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : boundary.size() - 1; }
};

}  // namespace smopt
