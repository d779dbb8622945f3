#include "smopt/geometry/triangle_batch.h"

#include <algorithm>
#include <cmath>

namespace smopt {
namespace {

float largest_of(const Eigen::Vector3f& p) {
  return p.cwiseAbs().maxCoeff();
}

}  // namespace

void TriangleBatch::gather(const TriangleGrid& grid, const std::vector<Vec3>& points,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles, const Box& space, const Vec3& center) {
  space_ = space;
  center_ = center;
  radius_ = 0;
  entries_.clear();
  boxes_.clear();
  grid.for_overlapping(space, [&](std::uint32_t f) {
    const std::array<std::uint32_t, 3>& t = triangles[f];
    const Eigen::Vector3f a = (points[t[0]] - center).cast<float>(), b = (points[t[1]] - center).cast<float>(),
                          c = (points[t[2]] - center).cast<float>();
    radius_ = std::max({radius_, largest_of(a), largest_of(b), largest_of(c)});
    if (entries_.size() % kLanes == 0) boxes_.emplace_back();
    boxes_.back().set(entries_.size() % kLanes, grid.box(f));
    entries_.push_back(Entry{{a[0], b[0], c[0], c[0]}, {a[1], b[1], c[1], c[1]}, {a[2], b[2], c[2], c[2]}, f, t});
  });
}

void TriangleBatch::move_corner(std::size_t i, std::uint32_t corner, const Vec3& point, const Box& box) {
  const Eigen::Vector3f p = (point - center_).cast<float>();
  Entry& entry = entries_[i];
  const auto put = [&](std::size_t lane) {
    entry.x[lane] = p[0];
    entry.y[lane] = p[1];
    entry.z[lane] = p[2];
  };
  for (std::size_t lane = 0; lane < 3; ++lane)
    if (entry.corners[lane] == corner) put(lane);
  if (entry.corners[2] == corner) put(3);
  boxes_[i / kLanes].set(i % kLanes, box);
}

}  // namespace smopt
