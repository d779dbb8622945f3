#pragma once

#include <span>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The triangles around each vertex, as one flat array (compressed rows). A triangle with a repeated corner stands in a row once for each
/// corner.
struct VertexStars {
  std::vector<std::uint32_t> offsets;  ///< vertex_count + 1 entries
  std::vector<FaceId> faces;           ///< 3 × triangle_count entries, ascending within a row

  [[nodiscard]] std::span<const FaceId> operator[](VertexId v) const { return {faces.data() + offsets[v], offsets[v + 1] - offsets[v]}; }
};

/// Cost: O(n).
VertexStars build_stars(const TriangleMesh& mesh);

/// Where vertex v stands in triangle t: 0, 1 or 2. \pre v is a corner of t.
inline int corner_of(const Triangle& t, VertexId v) {
  return t[0] == v ? 0 : (t[1] == v ? 1 : 2);
}

}  // namespace smopt
