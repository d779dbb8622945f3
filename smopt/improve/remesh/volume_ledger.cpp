#include "smopt/improve/remesh/volume_ledger.h"

#include <cmath>
#include <utility>

#include "smopt/geometry/triangle_shape.h"

namespace smopt {
namespace {

/// Of the longest spoke: how far a vertex goes at most for a debt in one step. A tenth changes no angle by more than some degrees.
constexpr double kLongestPaymentRel = 0.1;
/// Of the cube of the longest spoke: debts below this are rounding.
constexpr double kNegligibleDebtRel = 1e-9;

/// Six times the gradient of the enclosed volume by the vertex's position (twice the star's area vector), and the longest spoke.
struct StarArea {
  Vec3 doubled = Vec3::Zero();
  double longest2 = 0;
};

StarArea star_area(const EditableSurface& surface, VertexId v) {
  StarArea area;
  const Vec3& x = surface.point(v);
  const std::span<const VertexId> ring = surface.rings().vertices(v);
  Vec3 spoke = surface.point(ring.back()) - x;
  for (const VertexId w : ring) {
    const Vec3 next_spoke = surface.point(w) - x;
    area.doubled += spoke.cross(next_spoke);
    area.longest2 = std::max(area.longest2, next_spoke.squaredNorm());
    spoke = next_spoke;
  }
  return area;
}

double sextuple_volume_from(const EditableSurface& surface, const Vec3& origin, const Triangle& t) {
  return sextuple_volume(surface.point(t[0]) - origin, surface.point(t[1]) - origin, surface.point(t[2]) - origin);
}

}  // namespace

void VolumeLedger::book(const EditableSurface& surface, const Patch& patch) {
  double change = 0;
  for (const Triangle& t : patch.new_triangles) change += sextuple_volume_from(surface, patch.center, t);
  for (const FaceId f : patch.old_faces) change -= sextuple_volume_from(surface, patch.center, surface.mesh().triangles[f]);
  if (patch.added != kNoVertex) owed_[patch.added] = 0;
  if (patch.removed != kNoVertex) change -= std::exchange(owed_[patch.removed], 0);
  for (const VertexId w : patch.boundary) owed_[w] -= change / static_cast<double>(patch.boundary.size());
}

Vec3 VolumeLedger::keeping_volume(const EditableSurface& surface, VertexId v, const Vec3& step) const {
  const StarArea area = star_area(surface, v);
  const double norm2 = area.doubled.squaredNorm();
  if (!(norm2 > 0)) return step;
  Vec3 payment = (owed_[v] / norm2) * area.doubled;
  const double longest = kLongestPaymentRel * std::sqrt(area.longest2), length = payment.norm();
  if (length > longest) payment *= longest / length;
  return step - (step.dot(area.doubled) / norm2) * area.doubled + payment;
}

void VolumeLedger::book_move(const EditableSurface& surface, VertexId v, const Vec3& former) {
  // The area vector of a star does not depend on where its centre is.
  owed_[v] -= (surface.point(v) - former).dot(star_area(surface, v).doubled);
}

bool VolumeLedger::has_debt(const EditableSurface& surface, VertexId v) const {
  const double longest2 = star_area(surface, v).longest2;
  return std::abs(owed_[v]) > kNegligibleDebtRel * longest2 * std::sqrt(longest2);
}

double VolumeLedger::total() const {
  double sum = 0;
  for (const double owed : owed_) sum += owed;
  return sum / 6;
}

}  // namespace smopt
