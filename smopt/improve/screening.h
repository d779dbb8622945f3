#pragma once

#include <vector>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The vertices to smooth next: corners of low-quality triangles, and their neighbours, ascending.
struct ActiveSet {
  std::vector<VertexId> vertices;
  std::size_t low_quality = 0;  ///< low-quality triangles found
};

/// Chooses the active vertices of a mesh (Liu et al. 2017, section 0.3, "screening method").
class Screening {
 public:
  Screening(const TriangleMesh& mesh, const VertexRings& rings, const QualityThresholds& thresholds)
      : mesh_(mesh), rings_(rings), test_(thresholds), is_active_(mesh.vertex_count(), 0) {}

  /// Looks at every triangle. Cost: O(n), all cores.
  ActiveSet of_all();
  /// Looks at the triangles around the given vertices only. Cost: O(given).
  ActiveSet of_stars(const std::vector<VertexId>& vertices);

 private:
  ActiveSet of_faces(const std::vector<FaceId>& faces);
  void activate(VertexId v, ActiveSet& set);

  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  QualityTest test_;
  std::vector<char> is_active_;
};

}  // namespace smopt
