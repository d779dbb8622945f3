#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "smopt/mesh/stars.h"

namespace smopt {

/// The stars of a mesh that only loses vertices of valence 3 and 4: no star ever grows, so rows are edited in place.
class ShrinkingStars {
 public:
  explicit ShrinkingStars(const TriangleMesh& mesh) : stars_(build_stars(mesh)), valence_(mesh.vertex_count()) {
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) valence_[v] = static_cast<std::uint32_t>(stars_[v].size());
  }

  [[nodiscard]] std::span<const FaceId> operator[](VertexId v) const { return stars_[v].first(valence_[v]); }
  [[nodiscard]] std::uint32_t valence(VertexId v) const { return valence_[v]; }

  void remove(VertexId v, FaceId f) {
    FaceId* row = stars_.faces.data() + stars_.offsets[v];
    std::swap(*std::find(row, row + valence_[v], f), row[valence_[v] - 1]);
    --valence_[v];
  }
  /// \pre a triangle of v was removed before.
  void add(VertexId v, FaceId f) { stars_.faces[stars_.offsets[v] + valence_[v]++] = f; }

 private:
  VertexStars stars_;
  std::vector<std::uint32_t> valence_;
};

}  // namespace smopt
