#include "metrics/dihedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "metrics/edges.h"
#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

/// The corner of the triangle opposite to the side.
const Vec3& apex_of(const TriangleMesh& mesh, const EdgeUse& use) {
  return mesh.points[mesh.triangles[use.face][(use.side + 2U) % 3]];
}

/// Radians. Both normals are taken with the edge run through the same way, so that they point apart by the angle between the triangles.
double angle_between(const TriangleMesh& mesh, const EdgeUse& one, const EdgeUse& other) {
  const Vec3& from = mesh.points[one.low];
  const Vec3 along = mesh.points[one.high] - from;
  const Vec3 normal = along.cross(apex_of(mesh, one) - from).stableNormalized();
  const Vec3 other_normal = along.cross(apex_of(mesh, other) - from).stableNormalized();
  return std::atan2(normal.cross(other_normal).norm(), normal.dot(other_normal));
}

}  // namespace

std::optional<double> smallest_dihedral_deg(const TriangleMesh& mesh) {
  if (!has_finite_triangles(mesh)) return std::nullopt;
  std::optional<double> smallest;
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const double angle = angle_between(mesh, uses[0], uses[1]);
    smallest = std::min(smallest.value_or(angle), angle);
  });
  return smallest ? std::optional(*smallest * 180 / std::numbers::pi) : std::nullopt;
}

}  // namespace smopt::metrics
