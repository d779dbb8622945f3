#include "metrics/solvation/node_patches.h"

#include <algorithm>

namespace smopt::metrics {
namespace {

/// Area-weighted normals count as cancelled below this part of the summed areas: rounding leaves some 1e-16 of them.
constexpr double kCancelledRel = 1e-12;

/// Twice the area, along the normal.
Vec3 doubled_area_vector(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.points[t[0]];
  return (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
}

/// Triangles at a vertex, summed.
struct StarSum {
  Vec3 doubled_area_vector = Vec3::Zero();
  double doubled_area = 0;

  [[nodiscard]] bool is_cancelled() const { return !(doubled_area_vector.norm() > kCancelledRel * doubled_area); }
};

/// Over the triangles whose doubled area is above `least`.
StarSum sum_of_star(const TriangleMesh& mesh, const VertexStars& stars, VertexId v, double least) {
  StarSum sum;
  for (const FaceId f : stars[v]) {
    const Vec3 doubled = doubled_area_vector(mesh, mesh.triangles[f]);
    const double length = doubled.norm();
    if (!(length > least)) continue;
    sum.doubled_area_vector += doubled;
    sum.doubled_area += length;
  }
  return sum;
}

double longest_edge(const TriangleMesh& mesh, const VertexStars& stars, VertexId v) {
  double longest = 0;
  for (const FaceId f : stars[v])
    for (const VertexId w : mesh.triangles[f]) longest = std::max(longest, (mesh.points[w] - mesh.points[v]).norm());
  return longest;
}

NodePatch patch_of(const TriangleMesh& mesh, const VertexStars& stars, VertexId v) {
  NodePatch patch;
  const StarSum sum = sum_of_star(mesh, stars, v, 0);
  constexpr double kShare = 1.0 / 6;  // a third of the triangle, which is half of what its doubled area says
  patch.area = kShare * sum.doubled_area;
  patch.area_vector = kShare * sum.doubled_area_vector;
  patch.longest_edge = longest_edge(mesh, stars, v);
  if (!sum.is_cancelled()) patch.normal = sum.doubled_area_vector.normalized();
  return patch;
}

}  // namespace

std::vector<NodePatch> node_patches(const TriangleMesh& mesh, const VertexStars& stars) {
  std::vector<NodePatch> patches(mesh.vertex_count());
  for (VertexId v = 0; v < patches.size(); ++v) patches[v] = patch_of(mesh, stars, v);
  return patches;
}

std::vector<VertexId> degenerate_vertices(const TriangleMesh& mesh, const VertexStars& stars) {
  std::vector<VertexId> degenerate;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!stars[v].empty() && sum_of_star(mesh, stars, v, kLeastDoubledArea).is_cancelled()) degenerate.push_back(v);
  return degenerate;
}

}  // namespace smopt::metrics
