#include "smopt/improve/remesh/relaxation.h"

#include <algorithm>
#include <cmath>

#include "smopt/geometry/triangle_shape.h"

namespace smopt {
namespace {

/// Height of an equilateral triangle with edges of length 1.
const double kEquilateralHeight = std::sqrt(3.0) / 2;
/// Triangles worse than this count as if they were this bad: a single one does not decide alone.
constexpr double kWorstThatCounts = 0.05;

/// Calls visit(p, q) for the ring's points next to each other, relative to v.
template <class Visit>
void for_each_spoke_pair(const EditableSurface& surface, VertexId v, const Visit& visit) {
  const std::span<const VertexId> ring = surface.rings().vertices(v);
  const Vec3& x = surface.point(v);
  Vec3 p = surface.point(ring.back()) - x;
  for (const VertexId w : ring) {
    const Vec3 q = surface.point(w) - x;
    visit(p, q);
    p = q;
  }
}

}  // namespace

Vec3 step_to_centroid(const EditableSurface& surface, VertexId v) {
  Vec3 sum = Vec3::Zero();
  double areas = 0;
  for_each_spoke_pair(surface, v, [&](const Vec3& p, const Vec3& q) {
    const double area = p.cross(q).norm();
    sum += area * (p + q);
    areas += area;
  });
  return areas > 0 ? Vec3(sum / (3 * areas)) : Vec3(Vec3::Zero());
}

std::array<Vec3, 2> steps_to_better_angles(const RemeshState& state, VertexId v) {
  Vec3 mean = Vec3::Zero(), ideal = Vec3::Zero();
  double weights = 0;
  for_each_spoke_pair(state.surface, v, [&](const Vec3& p, const Vec3& q) {
    mean += p;
    const Vec3 inward = p.cross(q).cross(q - p);
    const double length = inward.norm();
    if (!(length > 0)) return;
    const double quality = std::max(kWorstThatCounts, state.quality.of_triangle(Vec3::Zero(), p, q));
    const double weight = 1 / (quality * quality * quality * quality);
    ideal += weight * (0.5 * (p + q) + kEquilateralHeight * (q - p).norm() / length * inward);
    weights += weight;
  });
  mean /= state.surface.valence(v);
  return {mean, weights > 0 ? Vec3(ideal / weights) : mean};
}

}  // namespace smopt
