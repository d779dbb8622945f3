#include "smopt/geometry/normal_cone.h"

#include <algorithm>
#include <cmath>

#include "smopt/geometry/predicates.h"

namespace smopt {
namespace {

/// Sum of the unit normals of a star, and the square of its longest spoke.
struct StarNormals {
  Vec3 sum = Vec3::Zero();
  double longest2 = 0;
};

StarNormals sum_normals(const Vec3& center, const std::vector<Vec3>& ring) {
  StarNormals result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 p = ring[i] - center;
    const Vec3 normal = p.cross(ring[i + 1 < ring.size() ? i + 1 : 0] - center);
    const double norm = normal.norm();
    if (norm > 0) result.sum += normal / norm;
    result.longest2 = std::max(result.longest2, p.squaredNorm());
  }
  return result;
}

bool is_positive(const Vec3& center, const std::vector<Vec3>& ring, const Vec3& axis, double margin, bool may_be_degenerate) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3& next = ring[i + 1 < ring.size() ? i + 1 : 0];
    const double component = axis.dot((ring[i] - center).cross(next - center));
    if (!(component > margin) && !(may_be_degenerate && are_collinear(center, ring[i], next))) return false;
  }
  return true;
}

/// Counts how often the ring, seen along the axis, comes up through a line through the centre: once a turn, as all its steps are
/// anticlockwise. Rounding moves the points by less than the margin that their triangles keep, so it cannot change the count.
int count_turns(const Vec3& center, const std::vector<Vec3>& ring, const Vec3& axis) {
  int smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vec3 across = axis.cross(Vec3::Unit(smallest));
  int turns = 0;
  bool was_below = across.dot(ring.back() - center) < 0;
  for (const Vec3& p : ring) {
    const bool is_below = across.dot(p - center) < 0;
    turns += was_below && !is_below ? 1 : 0;
    was_below = is_below;
  }
  return turns;
}

/// Widens the cone to hold all triangles of the star.
void widen_to_star(NormalCone& cone, const Vec3& center, const std::vector<Vec3>& ring, double longest2) {
  cone.squared_sine = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    widen(cone, reliable_direction((ring[i] - center).cross(ring[i + 1 < ring.size() ? i + 1 : 0] - center), longest2));
}

}  // namespace

NormalCone cone_around(std::span<const Eigen::Vector3f> normals) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& n : normals) sum += n;
  const float length = sum.norm();
  if (!(length > 0)) return {};
  NormalCone cone{{sum[0] / length, sum[1] / length, sum[2] / length}, 0};
  for (const Eigen::Vector3f& n : normals) widen(cone, n);
  return cone.squared_sine < NormalCone::kNoBound ? cone : NormalCone{};
}

NormalCone find_resting_cone(const Vec3& center, const std::vector<Vec3>& ring, std::span<const Eigen::Vector3f> normals) {
  const NormalCone cone = cone_around(normals);
  return is_known(cone) && count_turns(center, ring, axis_of(cone)) == 1 ? cone : NormalCone{};
}

NormalCone find_cone(const MovingStar& star) {
  const StarNormals from = sum_normals(star.center_from, star.ring_from), to = sum_normals(star.center_to, star.ring_to);
  const Vec3 mean = (from.sum + to.sum).normalized();
  NormalCone cone{{static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])}, NormalCone::kNoBound};
  if (!mean.allFinite() || !is_known(cone)) return {};
  const double margin = kConeMarginRel * std::max(from.longest2, to.longest2);
  const Vec3 direction = axis_of(cone);
  const bool is_cone = is_positive(star.center_to, star.ring_to, direction, margin, false) &&
                       is_positive(star.center_from, star.ring_from, direction, margin, true) &&
                       count_turns(star.center_to, star.ring_to, direction) == 1;
  if (!is_cone) return {};
  widen_to_star(cone, star.center_to, star.ring_to, to.longest2);
  return cone;
}

}  // namespace smopt
