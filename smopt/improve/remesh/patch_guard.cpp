#include "smopt/improve/remesh/patch_guard.h"

#include <algorithm>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/triangle_intersection.h"

namespace smopt {
namespace {

/// Triangles that reach farther, in radii of the patch, are left to the exact predicates.
constexpr float kOutlineReach = 4;

bool is_one_of(const std::vector<FaceId>& faces, FaceId f) {
  return std::ranges::find(faces, f) != faces.end();
}

}  // namespace

TrianglePoints PatchGuard::points_of(const Triangle& t) const {
  return {surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])};
}

Box PatchGuard::reach_of(const Patch& patch) const {
  const TriangleGrid& grid = surface_.guarded().grid;
  Box box = united(grid.box_of(patch.center), grid.box_of(patch.target));
  for (const VertexId w : patch.boundary) box.unite(grid.box_of(surface_.point(w)));
  return box;
}

bool PatchGuard::is_within_region(const Patch& patch) const {
  if (region_ == nullptr) return true;
  const TriangleGrid& grid = surface_.guarded().grid;
  return region_->contains(grid.reading(reach_of(patch))) &&
         std::ranges::all_of(patch.old_faces, [&](FaceId f) { return region_->contains(grid.home(f)); });
}

bool PatchGuard::must_wait(const Patch& patch) const {
  if (region_ == nullptr) return false;
  const TriangleGrid& grid = surface_.guarded().grid;
  return std::ranges::any_of(patch.new_triangles, [&](const Triangle& t) {
    return grid.needs_whole_grid(grid.box_of(surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])));
  });
}

bool PatchGuard::is_ok(const Patch& patch) {
  const bool has_axis = find_axis(patch);
  if (!has_axis && !is_fold_free(patch)) return false;
  has_outline_ = has_axis && patch.boundary.size() <= StarOutline::kMaxValence;
  if (has_outline_) draw_outline(patch);
  return is_clear_of_surroundings(patch);
}

/// Along the mean of all normals, old and new.
bool PatchGuard::find_axis(const Patch& patch) {
  directions_.clear();
  const auto add = [&](const Triangle& t) {
    directions_.push_back(reliable_direction(surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])));
  };
  for (const FaceId f : patch.old_faces) add(surface_.mesh().triangles[f]);
  for (const Triangle& t : patch.new_triangles) add(t);
  axis_.setZero();
  for (const Eigen::Vector3f& d : directions_) axis_ += d;
  axis_.normalize();
  if (!axis_.allFinite()) return false;
  if (!std::ranges::all_of(directions_, [&](const Eigen::Vector3f& d) { return d.dot(axis_) > 2 * kConeRounding; })) return false;
  // The star of an inner vertex turns once around its cone's axis, and so around every axis on which its normals are positive.
  return patch.removed == kNoVertex || surface_.guarded().cones[patch.removed].squared_sine < NormalCone::kNoBound;
}

bool PatchGuard::is_fold_free(const Patch& patch) const {
  const std::vector<Triangle>& all = patch.new_triangles;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TrianglePoints p = points_of(all[i]);
    if (are_collinear(p[0], p[1], p[2])) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (triangles_meet_beyond_shared(p, all[i], points_of(all[j]), all[j])) return false;
  }
  return true;
}

void PatchGuard::draw_outline(const Patch& patch) {
  spokes_.clear();
  double largest = (patch.target - patch.center).cwiseAbs().maxCoeff();
  for (const VertexId w : patch.boundary) {
    spokes_.push_back(surface_.point(w) - patch.center);
    largest = std::max(largest, spokes_.back().cwiseAbs().maxCoeff());
  }
  outline_radius_ = kOutlineReach * static_cast<float>(largest);
  outline_.set(spokes_, patch.target - patch.center, axis_, Vec3::Zero(), outline_radius_);
  seen_ = settled_ = 0;
  for (std::size_t k = 0; k < patch.boundary.size(); ++k) {
    if (!stars_.is_ring_vertex_seen_along(patch.boundary[k], axis_)) continue;
    seen_ |= 1U << k;
    settled_ |= (outline_.is_convex_at(k) ? 1U : 0U) << k;
  }
}

bool PatchGuard::is_clear_of_surroundings(const Patch& patch) {
  near_.clear();
  surface_.guarded().grid.for_overlapping(reach_of(patch), [&](FaceId f) { near_.push_back(f); });
  if (has_outline_)
    for (std::size_t k = 0; k < patch.boundary.size(); ++k) bits_.set(patch.boundary[k], 1U << k);
  const bool is_clear = std::ranges::all_of(near_, [&](FaceId f) {
    if (is_one_of(patch.old_faces, f)) return true;
    const Triangle& triangle = surface_.mesh().triangles[f];
    return (has_outline_ && is_clear_by_outline(patch, f, triangle)) || is_clear_of(patch, triangle);
  });
  if (has_outline_)
    for (const VertexId w : patch.boundary) bits_.unset(w);
  return is_clear;
}

bool PatchGuard::is_clear_by_outline(const Patch& patch, FaceId f, const Triangle& triangle) const {
  const unsigned own = bits_.of(triangle);
  if ((own & settled_) != 0) return true;
  const auto entry = TriangleBatch::Entry::of(f, triangle, surface_.mesh().points, patch.center);
  if (entry.radius() > outline_radius_) return false;
  if (own == 0 && outline_.is_clear_of(entry)) return true;
  return (own & ~seen_) == 0 && outline_.is_parted_from_others(entry, own);
}

bool PatchGuard::is_clear_of(const Patch& patch, const Triangle& triangle) const {
  const TrianglePoints p = points_of(triangle);
  const auto meets = [&](const Triangle& t) { return triangles_meet_beyond_shared(p, triangle, points_of(t), t); };
  if (std::ranges::any_of(patch.new_triangles, meets) || std::ranges::any_of(patch.walls, meets)) return false;
  return std::ranges::none_of(patch.swept, [&](const SweptTetrahedron& s) {
    const TrianglePoints base = points_of(s.base);
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_corner = triangle[i] == s.apex || std::ranges::count(s.base, triangle[i]) > 0;
      if (!is_corner && strictly_inside_tetrahedron(p[i], base[0], base[1], base[2], surface_.point(s.apex))) return true;
    }
    return false;
  });
}

}  // namespace smopt
