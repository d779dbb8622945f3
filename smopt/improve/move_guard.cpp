#include "smopt/improve/move_guard.h"

#include <algorithm>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/swept_triangle.h"

namespace smopt {
namespace {

/// Up to this valence a linear search of the ring is the fastest way to find a vertex on it.
constexpr std::size_t kLinearSearch = 64;

}  // namespace

void MoveGuard::select(VertexId v, const Vec3& reach) {
  vertex_ = v;
  position_ = surface_.mesh.points[v];
  ring_ = surface_.rings.vertices(v);
  ring_points_.clear();
  ring_filter_ = 0;
  // The box is made from the coordinates themselves: sums of differences may be off by a unit in the last place.
  Vec3 low = reach.cwiseMin(position_), high = reach.cwiseMax(position_);
  for (const VertexId w : ring_) {
    const Vec3& p = surface_.mesh.points[w];
    ring_points_.push_back(p - position_);
    ring_filter_ |= std::uint64_t{1} << (w % 64);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  reach_box_ = surface_.grid.box_of(low, high);
  ring_order_.clear();
  has_candidates_ = false;
}

bool MoveGuard::is_within(const TriangleGrid::CubeRange& region) const {
  const std::span<const FaceId> faces = surface_.rings.faces(vertex_);
  return region.contains(surface_.grid.cubes_of(reach_box_)) &&
         std::all_of(faces.begin(), faces.end(), [&](FaceId f) { return region.contains(surface_.grid.listing(f)); });
}

int MoveGuard::slot_of(VertexId w) const {
  if ((ring_filter_ >> (w % 64) & 1) == 0) return kNotOnRing;
  if (ring_.size() <= kLinearSearch) {
    for (std::size_t i = 0; i < ring_.size(); ++i)
      if (ring_[i] == w) return static_cast<int>(i);
    return kNotOnRing;
  }
  const auto it = std::lower_bound(ring_order_.begin(), ring_order_.end(), std::pair(w, 0));
  return it != ring_order_.end() && it->first == w ? it->second : kNotOnRing;
}

void MoveGuard::gather_candidates() {
  has_candidates_ = true;
  separation_.set_star(ring_points_);
  candidates_.clear();
  if (ring_.size() > kLinearSearch) {
    for (std::size_t i = 0; i < ring_.size(); ++i) ring_order_.emplace_back(ring_[i], static_cast<int>(i));
    std::sort(ring_order_.begin(), ring_order_.end());
  }
  surface_.grid.for_overlapping(reach_box_, [&](FaceId f) {
    const Triangle& t = surface_.mesh.triangles[f];
    if (t[0] == vertex_ || t[1] == vertex_ || t[2] == vertex_) return;
    Candidate candidate{f, {}, {}};
    for (int i = 0; i < 3; ++i) {
      candidate.slots[i] = slot_of(t[i]);
      candidate.points[i] = (surface_.mesh.points[t[i]] - position_).cast<float>();
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

Box MoveGuard::new_box(std::size_t slot) const {
  return surface_.grid.box_of(target_, surface_.mesh.points[ring_[slot]], surface_.mesh.points[ring_[next(slot)]]);
}

bool MoveGuard::needs_new_block() const {
  const std::span<const FaceId> faces = surface_.rings.faces(vertex_);
  for (std::size_t i = 0; i < ring_.size(); ++i)
    if (surface_.grid.needs_new_block(faces[i], new_box(i))) return true;
  return false;
}

void MoveGuard::apply() {
  surface_.mesh.points[vertex_] = target_;
  surface_.axes[vertex_] = vertex_axis_;
  const std::span<const FaceId> faces = surface_.rings.faces(vertex_);
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    surface_.axes[ring_[i]] = ring_axes_[i];
    surface_.grid.move(faces[i], new_box(i));
  }
}

void MoveGuard::prepare_target(const Vec3& target) {
  target_ = target;
  displacement_ = target - position_;
  normals_.clear();
  double longest2 = 0;
  // Not from `ring_points_`: where the vertex comes from far away, their rounding is above the margin.
  Vec3 spoke = surface_.mesh.points[ring_.front()] - target;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Vec3 next_spoke = surface_.mesh.points[ring_[next(i)]] - target;
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
  vertex_axis_ = surface_.axes[vertex_];
  const Vec3 axis = to_vector(vertex_axis_);
  if (is_known(vertex_axis_) && std::all_of(normals_.begin(), normals_.end(), [&](const Vec3& n) { return n.dot(axis) > cone_margin_; }))
    return true;
  vertex_axis_ = find_own_axis();
  return is_known(vertex_axis_) || (is_fold_free_at_target() && is_fold_free_on_the_way());
}

ConeAxis MoveGuard::find_own_axis() {
  scratch_star_.center_from = position_;
  scratch_star_.center_to = target_;
  scratch_star_.ring_from.clear();
  for (const VertexId w : ring_) scratch_star_.ring_from.push_back(surface_.mesh.points[w]);
  scratch_star_.ring_to = scratch_star_.ring_from;
  return find_cone_axis(scratch_star_);
}

ConeAxis MoveGuard::find_ring_axis(std::size_t slot) {
  const VertexId center = ring_[slot];
  scratch_star_.center_from = scratch_star_.center_to = surface_.mesh.points[center];
  scratch_star_.ring_from.clear();
  scratch_star_.ring_to.clear();
  for (const VertexId w : surface_.rings.vertices(center)) {
    scratch_star_.ring_from.push_back(surface_.mesh.points[w]);
    scratch_star_.ring_to.push_back(w == vertex_ ? target_ : surface_.mesh.points[w]);
  }
  return find_cone_axis(scratch_star_);
}

void MoveGuard::judge_ring_cones() {
  ring_axes_.resize(ring_.size());
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const ConeAxis& known = surface_.axes[ring_[i]];
    const Vec3 axis = to_vector(known);
    const bool is_kept = normals_[i].dot(axis) > cone_margin_ && normals_[previous(i)].dot(axis) > cone_margin_;
    ring_axes_[i] = is_kept ? known : find_ring_axis(i);
  }
}

bool MoveGuard::is_fold_free_at_target() const {
  const auto corner = [&](std::size_t k) -> const Vec3& { return surface_.mesh.points[ring_[k]]; };
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
    const Vec3 &a = surface_.mesh.points[ring_[k]], &b = surface_.mesh.points[ring_[next(k)]];
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      if (j == k || j == next(k)) continue;
      const Vec3& c = surface_.mesh.points[ring_[j]];
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
  const Triangle& t = surface_.mesh.triangles[candidate.face];
  SharedCorners shared;
  for (int i = 0; i < 3; ++i) {
    if (candidate.slots[i] == static_cast<int>(k)) shared.a = i;
    if (candidate.slots[i] == static_cast<int>(next(k))) shared.b = i;
  }
  return meets_sweep({surface_.mesh.points[t[0]], surface_.mesh.points[t[1]], surface_.mesh.points[t[2]]}, shared,
                     {surface_.mesh.points[ring_[k]], surface_.mesh.points[ring_[next(k)]], position_, target_});
}

}  // namespace smopt
