#include "smopt/geometry/triangle_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace smopt {
namespace {

/// Edge of a cube relative to the mean extent of a triangle's box. Smaller means more cubes to walk, larger more triangles to test;
/// measured on molecular surfaces, 1.5 to 2 is flat.
constexpr float kCellPerExtent = 1.8F;
/// A triangle that would be listed by more cubes than this is kept apart and tested by every query.
constexpr std::int64_t kMaxCellsPerTriangle = 4096;
/// Cube indices are 16-bit: the whole space is at most this many cubes across to either side of the origin.
constexpr float kMaxCellIndex = 31000.0F;
/// Buckets per triangle: a surface with two triangles a cube fills about a quarter of the hashed blocks it touches.
constexpr std::uint32_t kBucketsPerTriangle = 2;

float largest_extent(const Box& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

}  // namespace

TriangleGrid::TriangleGrid(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  choose_frame(points);
  boxes_.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) boxes_.push_back(box_of(points[a], points[b], points[c]));
  choose_cell_size();
  ranges_.reserve(triangles.size());
  for (const Box& box : boxes_) ranges_.push_back(cell_range(box));
  sort_into_buckets();
}

void TriangleGrid::choose_frame(const std::vector<Vec3>& points) {
  if (points.empty()) return;
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  origin_ = 0.5 * (low + high);
  half_extent_ = static_cast<float>((0.5 * (high - low)).maxCoeff());
}

void TriangleGrid::choose_cell_size() {
  double sum = 0;
  for (const Box& box : boxes_) sum += largest_extent(box);
  const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(boxes_.size(), 1)));
  const float cell = std::max({kCellPerExtent * mean, half_extent_ / kMaxCellIndex, std::numeric_limits<float>::min() * 16});
  cells_per_unit_ = 1 / cell;
  const auto wanted = std::max<std::size_t>(kBucketsPerTriangle * boxes_.size(), 64);
  bucket_mask_ = static_cast<std::uint32_t>(std::bit_ceil(wanted) - 1);
}

void TriangleGrid::sort_into_buckets() {
  const auto for_cells = [&](const Range& r, const auto& visit) {
    for (int x = r.low[0]; x <= r.high[0]; ++x)
      for (int y = r.low[1]; y <= r.high[1]; ++y)
        for (int z = r.low[2]; z <= r.high[2]; ++z) visit(bucket_of(x, y, z));
  };
  bucket_begin_.assign(std::size_t{bucket_mask_} + 2, 0);
  for (std::uint32_t f = 0; f < ranges_.size(); ++f) {
    if (cell_count(ranges_[f]) > kMaxCellsPerTriangle) {
      set_apart(f);
    } else {
      for_cells(ranges_[f], [&](std::uint32_t bucket) { ++bucket_begin_[bucket + 1]; });
    }
  }
  for (std::size_t i = 1; i < bucket_begin_.size(); ++i) bucket_begin_[i] += bucket_begin_[i - 1];
  entries_.resize(bucket_begin_.back());
  std::vector<std::uint32_t> end(bucket_begin_.begin(), bucket_begin_.end() - 1);
  std::size_t next_large = 0;
  for (std::uint32_t f = 0; f < ranges_.size(); ++f) {
    if (next_large < large_.size() && large_[next_large] == f) {
      ++next_large;
      continue;
    }
    for_cells(ranges_[f], [&](std::uint32_t bucket) { entries_[end[bucket]++] = f; });
  }
  added_head_.assign(std::size_t{bucket_mask_} + 1, kNone);
}

void TriangleGrid::set_apart(std::uint32_t f) {
  large_.push_back(f);
  ranges_[f] = {{-32768, -32768, -32768}, {32767, 32767, 32767}};  // contains every range: never extended again
}

void TriangleGrid::extend(std::uint32_t f, const Range& range) {
  Range& listed = ranges_[f];
  Range all = listed;
  for (int i = 0; i < 3; ++i) {
    all.low[i] = std::min(all.low[i], range.low[i]);
    all.high[i] = std::max(all.high[i], range.high[i]);
  }
  if (cell_count(all) > kMaxCellsPerTriangle) return set_apart(f);
  const auto is_listed = [&](int x, int y, int z) {
    return x >= listed.low[0] && x <= listed.high[0] && y >= listed.low[1] && y <= listed.high[1] && z >= listed.low[2] &&
           z <= listed.high[2];
  };
  for (int x = all.low[0]; x <= all.high[0]; ++x) {
    for (int y = all.low[1]; y <= all.high[1]; ++y) {
      for (int z = all.low[2]; z <= all.high[2]; ++z) {
        if (is_listed(x, y, z)) continue;
        const std::uint32_t bucket = bucket_of(x, y, z);
        added_.push_back({f, added_head_[bucket]});
        added_head_[bucket] = static_cast<std::uint32_t>(added_.size() - 1);
      }
    }
  }
  listed = all;
}

}  // namespace smopt
