#include "smopt/improve/move_guard.h"

#include <algorithm>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/swept_triangle.h"

namespace smopt {
MoveGuard::MoveGuard(TriangleMesh& mesh, const VertexRings& rings)
    : mesh_(mesh), rings_(rings), grid_(mesh.points, mesh.triangles), axes_(mesh.vertex_count()), ring_marks_(mesh.vertex_count(), 0) {}

void MoveGuard::select(VertexId v, const Vec3& reach) {
  mark_ring(false);
  vertex_ = v;
  position_ = mesh_.points[v];
  reach_ = reach;
  ring_ = rings_.vertices(v);
  ring_points_.clear();
  for (const VertexId w : ring_) ring_points_.push_back(mesh_.points[w] - position_);
  mark_ring(true);
  has_candidates_ = false;
}

void MoveGuard::mark_ring(bool is_selected) {
  for (std::size_t i = 0; i < ring_.size(); ++i) ring_marks_[ring_[i]] = static_cast<std::uint32_t>(is_selected ? i + 1 : 0);
}

void MoveGuard::gather_candidates() {
  has_candidates_ = true;
  separation_.set_star(ring_points_);
  candidates_.clear();
  // From the coordinates themselves: sums of differences may be off by a unit in the last place.
  Vec3 low = reach_.cwiseMin(position_), high = reach_.cwiseMax(position_);
  for (const VertexId w : ring_) {
    low = low.cwiseMin(mesh_.points[w]);
    high = high.cwiseMax(mesh_.points[w]);
  }
  grid_.for_overlapping(grid_.box_of(low, high), [&](FaceId f) {
    const Triangle& t = mesh_.triangles[f];
    if (t[0] == vertex_ || t[1] == vertex_ || t[2] == vertex_) return;
    Candidate candidate{f, {}, {}};
    for (int i = 0; i < 3; ++i) {
      candidate.slots[i] = static_cast<int>(ring_marks_[t[i]]) - 1;
      candidate.points[i] = (mesh_.points[t[i]] - position_).cast<float>();
    }
    candidates_.push_back(candidate);
  });
}

bool MoveGuard::is_move_ok(const Vec3& target) {
  prepare_target(target);
  if (!is_star_ok()) return false;
  judge_ring_cones();
  if (!has_candidates_) gather_candidates();
  separation_.set_target(displacement_, is_known(vertex_axis_) ? to_vector(vertex_axis_) : mean_normal());
  return std::all_of(candidates_.begin(), candidates_.end(), [&](const Candidate& c) { return is_clear_of(c); });
}

void MoveGuard::apply() {
  mesh_.points[vertex_] = target_;
  axes_[vertex_] = vertex_axis_;
  const std::span<const FaceId> faces = rings_.faces(vertex_);
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    axes_[ring_[i]] = ring_axes_[i];
    grid_.move(faces[i], grid_.box_of(target_, mesh_.points[ring_[i]], mesh_.points[ring_[next(i)]]));
  }
}

void MoveGuard::prepare_target(const Vec3& target) {
  target_ = target;
  displacement_ = target - position_;
  normals_.clear();
  double longest2 = 0;
  // Not from `ring_points_`: where the vertex comes from far away, their rounding is above the margin.
  Vec3 spoke = mesh_.points[ring_.front()] - target;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Vec3 next_spoke = mesh_.points[ring_[next(i)]] - target;
    normals_.push_back(spoke.cross(next_spoke));
    longest2 = std::max(longest2, spoke.squaredNorm());
    spoke = next_spoke;
  }
  cone_margin_ = kConeMarginRel * longest2;
}

Vec3 MoveGuard::mean_normal() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : normals_) sum += n;
  return sum.squaredNorm() > 0 ? sum : Vec3(Vec3::UnitZ());
}

bool MoveGuard::is_star_ok() {
  vertex_axis_ = axes_[vertex_];
  const Vec3 axis = to_vector(vertex_axis_);
  if (is_known(vertex_axis_) && std::all_of(normals_.begin(), normals_.end(), [&](const Vec3& n) { return n.dot(axis) > cone_margin_; }))
    return true;
  vertex_axis_ = find_own_axis();
  return is_known(vertex_axis_) || (is_fold_free_at_target() && is_fold_free_on_the_way());
}

ConeAxis MoveGuard::find_own_axis() const {
  std::vector<Vec3> ring;
  for (const VertexId w : ring_) ring.push_back(mesh_.points[w]);
  return find_cone_axis({position_, target_, ring, ring});
}

ConeAxis MoveGuard::find_ring_axis(std::size_t slot) const {
  const VertexId center = ring_[slot];
  MovingStar star{mesh_.points[center], mesh_.points[center], {}, {}};
  for (const VertexId w : rings_.vertices(center)) {
    star.ring_from.push_back(mesh_.points[w]);
    star.ring_to.push_back(w == vertex_ ? target_ : mesh_.points[w]);
  }
  return find_cone_axis(star);
}

void MoveGuard::judge_ring_cones() {
  ring_axes_.resize(ring_.size());
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const ConeAxis& known = axes_[ring_[i]];
    const Vec3 axis = to_vector(known);
    const bool is_kept = normals_[i].dot(axis) > cone_margin_ && normals_[previous(i)].dot(axis) > cone_margin_;
    ring_axes_[i] = is_kept ? known : find_ring_axis(i);
  }
}

bool MoveGuard::is_fold_free_at_target() const {
  const auto corner = [&](std::size_t k) -> const Vec3& { return mesh_.points[ring_[k]]; };
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    if (are_collinear(target_, corner(i), corner(next(i)))) return false;
    if (triangles_meet_beyond_edge({target_, corner(i), corner(previous(i))}, {target_, corner(i), corner(next(i))})) return false;
    for (std::size_t j = i + 2; j < ring_.size(); ++j) {
      if (next(j) == i) continue;  // shares an edge with i: tested as a neighbour
      if (triangles_meet_beyond_vertex({target_, corner(i), corner(next(i))}, {target_, corner(j), corner(next(j))})) return false;
    }
  }
  return true;
}

bool MoveGuard::is_fold_free_on_the_way() const {
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const Vec3 &a = mesh_.points[ring_[k]], &b = mesh_.points[ring_[next(k)]];
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      if (j == k || j == next(k)) continue;
      const Vec3& c = mesh_.points[ring_[j]];
      const int before = orient3d(a, b, c, position_), after = orient3d(a, b, c, target_);
      if (before == 0 && after == 0) return false;      // slides in one plane, where only a cone can vouch for it
      if (before == 0 || before * after > 0) continue;  // leaves a contact, or never comes to one
      if (touches_sector_on_the_way(a, b, c, position_, target_)) return false;
    }
  }
  return true;
}

bool MoveGuard::is_clear_of(const Candidate& candidate) {
  separation_.open_all();
  for (const int slot : candidate.slots) {
    // A cone of a shared vertex settles the two triangles of the star that have the vertex too.
    if (slot == kNotOnRing || !is_known(ring_axes_[static_cast<std::size_t>(slot)])) continue;
    separation_.close(static_cast<std::size_t>(slot));
    separation_.close(previous(static_cast<std::size_t>(slot)));
  }
  if (separation_.separate(candidate.points)) return true;
  for (std::size_t k = 0; k < ring_.size(); ++k)
    if (separation_.is_open(k) && meets_sweep_of(candidate, k)) return false;
  return true;
}

bool MoveGuard::meets_sweep_of(const Candidate& candidate, std::size_t k) const {
  const Triangle& t = mesh_.triangles[candidate.face];
  SharedCorners shared;
  for (int i = 0; i < 3; ++i) {
    if (candidate.slots[i] == static_cast<int>(k)) shared.a = i;
    if (candidate.slots[i] == static_cast<int>(next(k))) shared.b = i;
  }
  return meets_sweep({mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]}, shared,
                     {mesh_.points[ring_[k]], mesh_.points[ring_[next(k)]], position_, target_});
}

}  // namespace smopt
