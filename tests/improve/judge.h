#pragma once

#include <gmock/gmock.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

/// What the improvement promises, judged without any of its own predicates.
namespace smopt::testing {

using FacePair = std::pair<FaceId, FaceId>;

/// The intersecting pairs as CGAL sees them (`metrics::find_intersections`), sorted.
std::vector<FacePair> intersecting_pairs(const TriangleMesh& mesh);

/// The pairs of `after` that `before` does not have; `before` may be given as its pairs. \pre the faces of both have the same numbers.
std::vector<FacePair> new_pairs(const std::vector<FacePair>& before, const TriangleMesh& after);
std::vector<FacePair> new_pairs(const TriangleMesh& before, const TriangleMesh& after);

MATCHER(HasNoIntersections, negation ? "has intersecting triangles" : "has no two triangles that intersect") {
  const std::vector<FacePair> pairs = intersecting_pairs(arg);
  *result_listener << pairs.size() << " pairs";
  if (!pairs.empty()) *result_listener << ", the first " << pairs.front().first << " and " << pairs.front().second;
  return pairs.empty();
}

/// How often a closed surface winds around a point: 1 inside an outward surface, 0 outside, −1 inside an inward one. Sum of solid angles
/// (Van Oosterom and Strackee 1983), so not a whole number near the surface.
double winding_number(const TriangleMesh& mesh, const Vec3& point);

/// The smallest angle of one triangle and of all triangles, degrees.
double smallest_angle_deg(const Vec3& a, const Vec3& b, const Vec3& c);
double smallest_angle_deg(const TriangleMesh& mesh);

/// Shortest over longest edge.
double edge_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

/// How many triangles each vertex has.
std::vector<std::size_t> valences(const TriangleMesh& mesh);

/// The triangles from `first` on, `count` of them, with all points: one part of a mesh made by `joined`.
TriangleMesh part_of(const TriangleMesh& mesh, std::size_t first, std::size_t count);

/// Whether two meshes have the same points, bit for bit, and the same triangles.
bool is_same(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace smopt::testing
