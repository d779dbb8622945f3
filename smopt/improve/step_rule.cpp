#include "smopt/improve/step_rule.h"

#include <cmath>

namespace smopt {
namespace {

Vec3 step_to_mean(const Vec3& position, std::span<const VertexId> ring, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId w : ring) sum += points[w];
  return sum / static_cast<double>(ring.size()) - position;
}

/// Sum of weight(p, q) · (p × q) over the star's triangles with spokes p and q.
template <class Weight>
Vec3 weighted_normal(const Vec3& position, std::span<const VertexId> ring, const std::vector<Vec3>& points, const Weight& weight) {
  Vec3 sum = Vec3::Zero();
  Vec3 p = points[ring.back()] - position;
  for (const VertexId w : ring) {
    const Vec3 q = points[w] - position;
    const Vec3 normal = p.cross(q);
    sum += weight(p, q, normal) * normal;
    p = q;
  }
  return sum;
}

Vec3 without_component(const Vec3& step, const Vec3& normal) {
  const double norm2 = normal.squaredNorm();
  return norm2 > 0 ? Vec3(step - (step.dot(normal) / norm2) * normal) : step;
}

}  // namespace

Vec3 proposed_step(StepRule rule, const Vec3& position, std::span<const VertexId> ring, const std::vector<Vec3>& points) {
  const Vec3 step = step_to_mean(position, ring, points);
  switch (rule) {
    case StepRule::umbrella:
      return step;
    case StepRule::volume_preserving:
      return without_component(step, weighted_normal(position, ring, points, [](const Vec3&, const Vec3&, const Vec3&) { return 1.0; }));
    case StepRule::tangential:
      return without_component(step, weighted_normal(position, ring, points, [](const Vec3& p, const Vec3& q, const Vec3& normal) {
                                 const double norm = normal.norm();
                                 return norm > 0 ? std::atan2(norm, p.dot(q)) / norm : 0.0;
                               }));
  }
  return step;
}

}  // namespace smopt
