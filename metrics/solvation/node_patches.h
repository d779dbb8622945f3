#pragma once

#include <vector>

#include "smopt/mesh/stars.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// A vertex's share of the surface: a third of each triangle of its star, which is also what its linear shape function integrates to.
struct NodePatch {
  double area = 0;                  ///< Å²
  Vec3 area_vector = Vec3::Zero();  ///< Σ area · normal over the patch, Å²
  Vec3 normal = Vec3::Zero();       ///< of unit length; 0 where the vertex has none
  double longest_edge = 0;          ///< of the star's edges at the vertex, Å

  [[nodiscard]] bool has_normal() const { return normal != Vec3::Zero(); }
};

/// \pre closed, oriented, each vertex in a triangle. Cost: O(n).
std::vector<NodePatch> node_patches(const TriangleMesh& mesh, const VertexStars& stars);

/// Triangles with no more than twice this area, Å², do not count for AFMPB's normals.
inline constexpr double kLeastDoubledArea = 1e-8;

/// The vertices at which AFMPB fails, ascending: it adds up the area-weighted normals of the triangles with a doubled area above
/// kLeastDoubledArea and divides by the sum's length without a look at it, so that a vertex without such triangles, or whose normals cancel to nothing,
/// makes everything NaN. Cancelled counts what is below 1e-12 of the triangles' area. Cost: O(n).
std::vector<VertexId> degenerate_vertices(const TriangleMesh& mesh, const VertexStars& stars);

}  // namespace smopt::metrics
