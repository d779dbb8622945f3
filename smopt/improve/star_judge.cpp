#include "smopt/improve/star_judge.h"

#include <algorithm>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/triangle_intersection.h"

namespace smopt {

bool StarJudge::is_free_of_folds(const StarMove& move) {
  move_ = &move;
  directions_.clear();
  for (const Vec3& n : move.target_normals()) directions_.push_back(reliable_direction(n, move.target_longest2()));
  if (!has_cone() && !(is_fold_free_at_target() && is_fold_free_on_the_way())) return false;
  update_ring_cones();
  return true;
}

bool StarJudge::has_cone() {
  const NormalCone& known = surface_.cones[move_->vertex()];
  const Eigen::Vector3f axis = single_axis_of(known);
  const auto is_along = [&](const Eigen::Vector3f& direction) { return direction.dot(axis) > 2 * kConeRounding; };
  is_projected_ = known.squared_sine < NormalCone::kNoBound && std::all_of(directions_.begin(), directions_.end(), is_along);
  cone_ = is_projected_ ? cone_around(directions_) : find_own_cone();
  if (is_projected_ && !is_known(cone_)) cone_ = {known.axis, NormalCone::kNoBound};
  return is_known(cone_);
}

NormalCone StarJudge::find_own_cone() {
  scratch_star_.center_from = move_->position();
  scratch_star_.center_to = move_->target();
  scratch_star_.ring_from = move_->ring_points();
  scratch_star_.ring_to = move_->ring_points();
  return find_cone(scratch_star_);
}

NormalCone StarJudge::find_ring_cone(std::size_t slot) {
  const VertexId center = move_->ring()[slot];
  scratch_star_.center_from = scratch_star_.center_to = surface_.mesh.points[center];
  scratch_star_.ring_from.clear();
  scratch_star_.ring_to.clear();
  for (const VertexId w : surface_.rings.vertices(center)) {
    scratch_star_.ring_from.push_back(surface_.mesh.points[w]);
    scratch_star_.ring_to.push_back(w == move_->vertex() ? move_->target() : surface_.mesh.points[w]);
  }
  return find_cone(scratch_star_);
}

void StarJudge::update_ring_cones() {
  ring_cones_.resize(move_->valence());
  for (std::size_t k = 0; k < move_->valence(); ++k) {
    NormalCone cone = surface_.cones[move_->ring()[k]];
    widen(cone, directions_[k]);
    widen(cone, directions_[move_->previous(k)]);
    ring_cones_[k] = cone.squared_sine < NormalCone::kNoBound ? cone : find_ring_cone(k);
  }
}

bool StarJudge::is_fold_free_at_target() const {
  const Vec3& target = move_->target();
  const std::vector<Vec3>& ring = move_->ring_points();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (are_collinear(target, ring[i], ring[move_->next(i)])) return false;
    if (triangles_meet_beyond_edge({target, ring[i], ring[move_->previous(i)]}, {target, ring[i], ring[move_->next(i)]})) return false;
    for (std::size_t j = i + 2; j < ring.size(); ++j) {
      if (move_->next(j) == i) continue;  // shares an edge with i: tested as a neighbour
      if (triangles_meet_beyond_vertex({target, ring[i], ring[move_->next(i)]}, {target, ring[j], ring[move_->next(j)]})) return false;
    }
  }
  return true;
}

bool StarJudge::is_fold_free_on_the_way() const {
  const std::vector<Vec3>& ring = move_->ring_points();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 &a = ring[k], &b = ring[move_->next(k)];
    for (std::size_t j = 0; j < ring.size(); ++j) {
      if (j == k || j == move_->next(k)) continue;
      const Vec3& c = ring[j];
      const int before = orient3d(a, b, c, move_->position()), after = orient3d(a, b, c, move_->target());
      if (before == 0 && after == 0) return false;      // slides in one plane, where only a cone can vouch for it
      if (before == 0 || before * after > 0) continue;  // leaves a contact, or never comes to one
      if (touches_sector_on_the_way(a, b, c, move_->position(), move_->target())) return false;
    }
  }
  return true;
}

bool StarJudge::is_ring_vertex_seen_along(VertexId w, const Eigen::Vector3f& axis) const {
  const NormalCone& cone = surface_.cones[w];
  if (is_seen_along(cone, axis)) return true;
  if (cone.squared_sine == NormalCone::kNoBound) return false;
  const Vec3& center = surface_.mesh.points[w];
  const std::span<const VertexId> ring = surface_.rings.vertices(w);
  Vec3 spoke = surface_.mesh.points[ring.back()] - center;
  for (const VertexId u : ring) {
    const Vec3 next_spoke = surface_.mesh.points[u] - center;
    const double longest2 = std::max(spoke.squaredNorm(), next_spoke.squaredNorm());
    if (!(reliable_direction(spoke.cross(next_spoke), longest2).dot(axis) > 2 * kConeRounding)) return false;
    spoke = next_spoke;
  }
  return true;
}

}  // namespace smopt
