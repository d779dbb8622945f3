#include "smopt/improve/exact_guard.h"

#include <algorithm>

#include "smopt/geometry/swept_triangle.h"

namespace smopt {
namespace {

/// Up to this valence a linear search of the ring is the fastest way to find a vertex on it.
constexpr std::size_t kLinearSearch = 64;

}  // namespace

void ExactGuard::enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) {
  group_ = group;
  region_ = region;
  surroundings_.clear();
}

void ExactGuard::select(const StarMove& move, const Vec3& reach) {
  move_ = &move;
  // The box is made from the coordinates themselves: sums of differences may be off by a unit in the last place.
  reach_box_ = united(surface_.grid.box_of(move.position()), surface_.grid.box_of(reach));
  ring_boxes_.clear();
  for (const Vec3& p : move.ring_points()) {
    ring_boxes_.push_back(surface_.grid.box_of(p));
    reach_box_.unite(ring_boxes_.back());
  }
  ring_order_.clear();
}

bool ExactGuard::is_within_region() const {
  if (region_ == nullptr) return true;
  const std::span<const FaceId> faces = move_->faces();
  return region_->contains(surface_.grid.reading(reach_box_)) &&
         std::all_of(faces.begin(), faces.end(), [&](FaceId f) { return region_->contains(surface_.grid.home(f)); });
}

bool ExactGuard::is_ok() {
  is_separation_ready_ = false;
  if (!star_.is_free_of_folds(*move_)) return false;
  if (!surroundings_.covers(reach_box_)) fetch_surroundings();
  if (!is_clear_of_surroundings()) return false;
  compute_boxes();
  return true;
}

void ExactGuard::fetch_surroundings() {
  Box space = reach_box_;
  for (const VertexId v : group_) {  // asks for memory that will be needed
    __builtin_prefetch(surface_.rings.vertices(v).data());
    __builtin_prefetch(surface_.rings.faces(v).data());
    __builtin_prefetch(&surface_.cones[v]);
  }
  for (const VertexId v : group_) space.unite(star_box(v));
  if (region_ != nullptr && !region_->contains(surface_.grid.reading(space))) space = reach_box_;
  surroundings_.gather(surface_.grid, surface_.mesh.points, surface_.mesh.triangles, space, move_->position());
}

Box ExactGuard::star_box(VertexId v) const {
  Box box = surface_.grid.box_of(surface_.mesh.points[v]);
  for (const VertexId w : surface_.rings.vertices(v)) box.unite(surface_.grid.box_of(surface_.mesh.points[w]));
  return box;
}

void ExactGuard::draw_outline() {
  settled_ = with_cone_ = 0;
  has_outline_ = star_.is_projected() && move_->valence() <= StarOutline::kMaxValence;
  if (!has_outline_) return;
  const Eigen::Vector3f axis = single_axis_of(surface_.cones[move_->vertex()]);
  outline_.set(move_->spokes(), move_->displacement(), axis, move_->position() - surroundings_.center(), surroundings_.radius());
  for (std::size_t k = 0; k < move_->valence(); ++k) {
    const VertexId w = move_->ring()[k];
    with_cone_ |= (is_known(star_.ring_cones()[k]) ? 1U : 0U) << k;
    if (outline_.is_convex_at(k) && star_.is_ring_vertex_seen_along(w, axis)) settled_ |= 1U << k;
    bits_.set(w, 1U << k);
  }
}

bool ExactGuard::is_clear_of_surroundings() {
  bits_.set(move_->vertex(), VertexBits::kCenter);  // before the ring: it must have its bit
  draw_outline();
  sort_surroundings();
  return std::all_of(open_.begin(), open_.end(), [&](const Open& open) {
    const TriangleBatch::Entry& triangle = surroundings_[open.place];
    return (has_outline_ && is_clear_by_outline(triangle, open.own)) || is_clear_of(triangle);
  });
}

/// Without branches, which would be mispredicted.
void ExactGuard::sort_surroundings() {
  const std::span<const std::uint32_t> near = surroundings_.near(reach_box_);
  star_places_.resize(near.size());
  open_.resize(near.size());
  std::size_t in_star = 0, open = 0;
  for (const std::uint32_t i : near) {
    const unsigned own = bits_.of(surroundings_[i].corners);
    star_places_[in_star] = i;
    in_star += own >> 31;
    open_[open] = {i, own};
    open += (own & (settled_ | VertexBits::kCenter)) == 0 ? 1 : 0;
  }
  star_places_.resize(in_star);
  open_.resize(open);
  bits_.unset(move_->vertex());
  if (!has_outline_) return;
  for (const VertexId w : move_->ring()) bits_.unset(w);
}

bool ExactGuard::is_clear_by_outline(const TriangleBatch::Entry& triangle, unsigned own) const {
  if (own == 0) return outline_.is_clear_of(triangle);
  // The cones of shared vertices settle the star's triangles that have them.
  return (own & ~with_cone_) == 0 && outline_.is_parted_from_others(triangle, own);
}

void ExactGuard::compute_boxes() {
  const std::span<const FaceId> faces = move_->faces();
  const Box target = surface_.grid.box_of(move_->target());
  new_boxes_.resize(faces.size());
  leaves_home_.resize(faces.size());
  for (std::size_t k = 0; k < faces.size(); ++k) {
    new_boxes_[k] = united(united(ring_boxes_[k], ring_boxes_[move_->next(k)]), target);
    leaves_home_[k] = surface_.grid.stays_at_home(faces[k], new_boxes_[k]) ? 0 : 1;
  }
}

bool ExactGuard::must_wait() const {
  if (region_ == nullptr) return false;
  for (std::size_t k = 0; k < move_->valence(); ++k)
    if (leaves_home_[k] != 0 && surface_.grid.needs_whole_grid(new_boxes_[k])) return true;
  return false;
}

void ExactGuard::apply() {
  surface_.mesh.points[move_->vertex()] = move_->target();
  surface_.cones[move_->vertex()] = star_.cone();
  const std::span<const FaceId> faces = move_->faces();
  for (std::size_t k = 0; k < faces.size(); ++k) {
    surface_.cones[move_->ring()[k]] = star_.ring_cones()[k];
    if (leaves_home_[k] != 0)
      surface_.grid.move(faces[k], new_boxes_[k]);
    else
      surface_.grid.move_at_home(faces[k], new_boxes_[k]);
  }
  for (const std::uint32_t i : star_places_)
    surroundings_.move_corner(i, move_->vertex(), move_->target(), surface_.grid.box(surroundings_[i].face));
}

Vec3 ExactGuard::mean_normal() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : move_->target_normals()) sum += n;
  return sum.squaredNorm() > 0 ? sum : Vec3(Vec3::UnitZ());
}

void ExactGuard::prepare_separation() {
  is_separation_ready_ = true;
  separation_.set_star(move_->spokes());
  separation_.set_target(move_->displacement(), is_known(star_.cone()) ? axis_of(star_.cone()) : mean_normal());
  if (move_->valence() <= kLinearSearch || !ring_order_.empty()) return;
  for (std::size_t i = 0; i < move_->valence(); ++i) ring_order_.emplace_back(move_->ring()[i], static_cast<int>(i));
  std::sort(ring_order_.begin(), ring_order_.end());
}

int ExactGuard::slot_of(VertexId w) const {
  const std::span<const VertexId> ring = move_->ring();
  if (ring.size() <= kLinearSearch) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (ring[i] == w) return static_cast<int>(i);
    return kNotOnRing;
  }
  const auto it = std::lower_bound(ring_order_.begin(), ring_order_.end(), std::pair(w, 0));
  return it != ring_order_.end() && it->first == w ? it->second : kNotOnRing;
}

bool ExactGuard::is_clear_of(const TriangleBatch::Entry& triangle) {
  if (!is_separation_ready_) prepare_separation();
  separation_.open_all();
  std::array<int, 3> slots{};
  SweepSeparation::Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    slots[i] = slot_of(triangle.corners[i]);
    corners[i] = (surface_.mesh.points[triangle.corners[i]] - move_->position()).cast<float>();
    // A cone of a shared vertex settles the two triangles of the star that have the vertex too.
    if (slots[i] == kNotOnRing || !is_known(star_.ring_cones()[static_cast<std::size_t>(slots[i])])) continue;
    separation_.close(static_cast<std::size_t>(slots[i]));
    separation_.close(move_->previous(static_cast<std::size_t>(slots[i])));
  }
  if (separation_.separate(corners)) return true;
  for (std::size_t k = 0; k < move_->valence(); ++k)
    if (separation_.is_open(k) && meets_sweep_of(triangle.corners, slots, k)) return false;
  return true;
}

bool ExactGuard::meets_sweep_of(const Triangle& t, const std::array<int, 3>& slots, std::size_t k) const {
  SharedCorners shared;
  for (int i = 0; i < 3; ++i) {
    if (slots[static_cast<std::size_t>(i)] == static_cast<int>(k)) shared.a = i;
    if (slots[static_cast<std::size_t>(i)] == static_cast<int>(move_->next(k))) shared.b = i;
  }
  const std::vector<Vec3>& ring = move_->ring_points();
  return meets_sweep({surface_.mesh.points[t[0]], surface_.mesh.points[t[1]], surface_.mesh.points[t[2]]}, shared,
                     {ring[k], ring[move_->next(k)], move_->position(), move_->target()});
}

}  // namespace smopt
