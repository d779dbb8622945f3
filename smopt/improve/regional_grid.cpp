#include "smopt/improve/regional_grid.h"

#include <algorithm>
#include <cassert>

#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Around the boxes, in their largest extent, when the region turned out to be too small for the first time.
constexpr double kFirstMargin = 0.5;
/// Edge of a cell relative to the mean extent of the boxes. Smaller follows them more closely, larger gives a triangle fewer cells.
constexpr double kCellPerExtent = 0.7;

}  // namespace

void RegionalGrid::move(FaceId f) {
  const auto& [a, b, c] = mesh_.triangles[f];
  grid_->move(index_of(f), grid_->box_of(mesh_.points[a], mesh_.points[b], mesh_.points[c]));
}

std::uint32_t RegionalGrid::index_of(FaceId f) const {
  const auto at = std::lower_bound(faces_.begin(), faces_.end(), f);
  assert(at != faces_.end() && *at == f);
  return static_cast<std::uint32_t>(at - faces_.begin());
}

void RegionalGrid::build_for(const Extent& box) {
  expected_.push_back(box);
  if (region_) margin_ = std::max(kFirstMargin, 2 * margin_);
  mark_region();
  faces_ = faces_in_region();
  std::vector<Triangle> triangles;
  triangles.reserve(faces_.size());
  for (const FaceId f : faces_) triangles.push_back(mesh_.triangles[f]);
  grid_.emplace(mesh_.points, triangles);
}

void RegionalGrid::mark_region() {
  double sum = 0;
  for (const Extent& box : expected_) sum += (box.high - box.low).maxCoeff();
  region_.emplace(kCellPerExtent * sum / static_cast<double>(expected_.size()));
  for (const Extent& box : expected_) {
    const Vec3 margin = Vec3::Constant(margin_ * (box.high - box.low).maxCoeff());
    region_->mark({box.low - margin, box.high + margin});
  }
}

std::vector<FaceId> RegionalGrid::faces_in_region() const {
  std::vector<char> is_in(mesh_.triangle_count(), 0);
  for_ranges_in_parallel(mesh_.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 &a = mesh_.points[mesh_.triangles[f][0]], &b = mesh_.points[mesh_.triangles[f][1]],
                 &c = mesh_.points[mesh_.triangles[f][2]];
      is_in[f] = is_removed_[f] == 0 && region_->reaches({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)}) ? 1 : 0;
    }
  });
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < is_in.size(); ++f)
    if (is_in[f] != 0) faces.push_back(f);
  return faces;
}

}  // namespace smopt
