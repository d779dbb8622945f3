#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A copy of a mesh whose vertices and triangles are numbered along a curve that fills space (Morton 1966), so that what is close in space is
/// close in memory: on large meshes, work on a neighbourhood then finds it in the cache. Shape, and the order of corners, stay as they are.
class SpatiallyOrderedMesh {
 public:
  /// Cost: O(n).
  explicit SpatiallyOrderedMesh(const TriangleMesh& original);

  [[nodiscard]] TriangleMesh& mesh() { return mesh_; }
  /// The vertices in the order of the original.
  [[nodiscard]] const std::vector<VertexId>& in_original_order() const { return number_; }
  /// Gives the points back to the mesh that this is a copy of.
  void copy_points_to(TriangleMesh& original) const;

 private:
  std::vector<VertexId> number_;  // per vertex of the original: its number here
  TriangleMesh mesh_;
};

}  // namespace smopt
