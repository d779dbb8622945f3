#include "smopt/geometry/triangle_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace smopt {
namespace {

/// Edge of a cube relative to the mean extent of a triangle's box. Smaller means more cubes to walk, larger more triangles to test;
/// measured on molecular surfaces, 1.5 to 2 is flat.
constexpr float kCellPerExtent = 1.5F;
/// A triangle that would be listed by more cubes than this is kept apart and tested by every query.
constexpr std::int64_t kMaxCellsPerTriangle = 4096;
/// Cube indices are 16-bit: the whole space is at most this many cubes across to either side of the origin.
constexpr float kMaxCellIndex = 31000.0F;
/// The hash table starts with room for this many blocks.
constexpr std::size_t kInitialTable = 1024;

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
  sort_into_cubes();
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
}

std::uint32_t TriangleGrid::find_or_add_block(int x, int y, int z) {
  const std::uint32_t known = find_block(x, y, z);
  if (known != kNone) return known;
  const auto block = static_cast<std::uint32_t>(block_keys_.size());
  block_keys_.push_back(block_key(x, y, z));
  if (2 * block_keys_.size() > table_.size())
    grow_table();
  else
    put_into_table(block_keys_.back(), block);
  return block;
}

void TriangleGrid::put_into_table(std::uint64_t key, std::uint32_t block) {
  std::size_t slot = table_slot(key);
  while (table_[slot].block != kNone) slot = slot + 1 < table_.size() ? slot + 1 : 0;
  table_[slot] = {key, block};
}

void TriangleGrid::grow_table() {
  table_.assign(2 * std::max(table_.size(), kInitialTable / 2), {0, kNone});
  table_shift_ = 64 - std::countr_zero(table_.size());
  for (std::uint32_t block = 0; block < block_keys_.size(); ++block) put_into_table(block_keys_[block], block);
}

std::size_t TriangleGrid::find_or_add_cube(int x, int y, int z) {
  return std::size_t{find_or_add_block(x >> 2, y >> 2, z >> 2)} * kCubesPerBlock + static_cast<std::size_t>(cell_in_block(x, y, z));
}

void TriangleGrid::sort_into_cubes() {
  grow_table();
  const auto for_cubes = [&](const Range& r, const auto& visit) {
    for (int x = r.low[0]; x <= r.high[0]; ++x)
      for (int y = r.low[1]; y <= r.high[1]; ++y)
        for (int z = r.low[2]; z <= r.high[2]; ++z) visit(find_or_add_cube(x, y, z));
  };
  std::vector<char> is_apart(ranges_.size(), 0);
  std::vector<std::uint32_t> count;
  for (std::uint32_t f = 0; f < ranges_.size(); ++f) {
    is_apart[f] = cell_count(ranges_[f]) > kMaxCellsPerTriangle ? 1 : 0;
    if (is_apart[f] != 0) {
      set_apart(f);
      continue;
    }
    for_cubes(ranges_[f], [&](std::size_t cube) {
      if (cube >= count.size()) count.resize(block_keys_.size() * kCubesPerBlock, 0);
      ++count[cube];
    });
  }
  cube_begin_.assign(block_keys_.size() * kCubesPerBlock + 1, 0);
  for (std::size_t i = 0; i < count.size(); ++i) cube_begin_[i + 1] = cube_begin_[i] + count[i];
  entries_.resize(cube_begin_.back());
  std::copy(cube_begin_.begin(), cube_begin_.end() - 1, count.begin());  // now: where the next entry goes
  for (std::uint32_t f = 0; f < ranges_.size(); ++f)
    if (is_apart[f] == 0) for_cubes(ranges_[f], [&](std::size_t cube) { entries_[count[cube]++] = f; });
  added_head_.assign(block_keys_.size() * kCubesPerBlock, kNone);
}

void TriangleGrid::set_apart(std::uint32_t f) {
  large_.push_back(f);
  ranges_[f] = {{kApart, kApart, kApart}, {32767, 32767, 32767}};  // contains every range: never extended again
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
        const std::size_t cube = find_or_add_cube(x, y, z);
        if (cube >= added_head_.size()) {
          added_head_.resize(block_keys_.size() * kCubesPerBlock, kNone);
          cube_begin_.resize(block_keys_.size() * kCubesPerBlock + 1, static_cast<std::uint32_t>(entries_.size()));
        }
        added_.push_back({f, added_head_[cube]});
        added_head_[cube] = static_cast<std::uint32_t>(added_.size() - 1);
      }
    }
  }
  listed = all;
}

}  // namespace smopt
