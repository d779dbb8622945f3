#include "smopt/improve/star_replacement.h"

#include <algorithm>
#include <cmath>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/triangle_intersection.h"
#include "smopt/geometry/triangle_shape.h"

namespace smopt {
namespace {

using Ring = std::span<const VertexId>;

double longest_spoke(const TriangleMesh& mesh, VertexId v, Ring ring) {
  double longest = 0;
  for (const VertexId w : ring) longest = std::max(longest, (mesh.points[w] - mesh.points[v]).norm());
  return longest;
}

double distance_to_ring_plane(const TriangleMesh& mesh, VertexId v, Ring ring) {
  const Vec3 &a = mesh.points[ring[0]], &b = mesh.points[ring[1]], &c = mesh.points[ring[2]];
  const Vec3 normal = doubled_area_vector(a, b, c);
  const double norm = normal.norm();
  return norm > 0 ? std::abs(normal.dot(mesh.points[v] - a)) / norm : HUGE_VAL;
}

double distance_to_diagonal(const TriangleMesh& mesh, VertexId v, Ring ring, std::size_t i) {
  return distance_to_open_segment(mesh.points[v], mesh.points[ring[i]], mesh.points[ring[i + 2]]);
}

TrianglePoints points_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

}  // namespace

StarReplacements replacements_within_tolerance(const TriangleMesh& mesh, VertexId v, Ring ring, const RedundantPointOptions& options) {
  const double tolerance = options.tolerance * (options.is_tolerance_relative ? longest_spoke(mesh, v, ring) : 1.0);
  StarReplacements result;
  const auto add = [&](const StarReplacement& replacement) { result.replacements[result.count++] = replacement; };
  if (ring.size() == 3) {
    if (distance_to_ring_plane(mesh, v, ring) < tolerance) add({{Triangle{ring[0], ring[1], ring[2]}}, 1});
    return result;
  }
  const std::array<double, 2> distance{distance_to_diagonal(mesh, v, ring, 0), distance_to_diagonal(mesh, v, ring, 1)};
  const std::size_t nearest = distance[1] < distance[0] ? 1 : 0;
  for (const std::size_t i : {nearest, 1 - nearest}) {
    if (!(distance[i] < tolerance)) continue;
    add({{Triangle{ring[i], ring[i + 1], ring[i + 2]}, Triangle{ring[i], ring[i + 2], ring[(i + 3) % 4]}}, 2});
  }
  return result;
}

bool is_degenerate(const TriangleMesh& mesh, const StarReplacement& replacement) {
  for (const Triangle& t : replacement.all()) {
    const TrianglePoints p = points_of(mesh, t);
    if (are_collinear(p[0], p[1], p[2])) return true;
  }
  const auto& [first, second] = replacement.triangles;
  return replacement.count == 2 && triangles_meet_beyond_shared(points_of(mesh, first), first, points_of(mesh, second), second);
}

bool meets_replacement(const TriangleMesh& mesh, FaceId f, VertexId v, const StarReplacement& replacement) {
  const Triangle& t = mesh.triangles[f];
  const TrianglePoints p = points_of(mesh, t);
  for (const Triangle& s : replacement.all()) {
    const TrianglePoints q = points_of(mesh, s);
    if (triangles_meet_beyond_shared(p, t, q, s)) return true;
    for (int j = 0; j < 3; ++j) {
      const bool is_corner = t[j] == s[0] || t[j] == s[1] || t[j] == s[2];
      if (!is_corner && strictly_inside_tetrahedron(p[j], q[0], q[1], q[2], mesh.points[v])) return true;
    }
  }
  if (replacement.count == 1) return false;
  const Triangle wall{v, replacement.triangles[0][0], replacement.triangles[0][2]};  // between the two tetrahedra
  return triangles_meet_beyond_shared(p, t, points_of(mesh, wall), wall);
}

}  // namespace smopt
