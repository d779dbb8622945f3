#include "smopt/geometry/triangle_grid.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace smopt {
namespace {

/// Edge of a cube relative to the mean extent of a triangle's box. Smaller means more cubes to walk, larger more triangles to test;
/// measured on molecular surfaces, 1.5 to 2 is flat.
constexpr float kCubePerExtent = 1.5F;
/// A triangle that would be listed by more cubes than this is kept apart and tested by every query.
constexpr std::int64_t kMaxCubesPerTriangle = 4096;
/// Cube indices are 16-bit: the whole space is at most this many cubes across to either side of the origin.
constexpr float kMaxCubeIndex = 31000.0F;
/// The hash table starts with room for this many blocks.
constexpr std::size_t kInitialTable = 1024;

float largest_extent(const Box& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

/// Triangles a task when something is done for each of them.
constexpr std::uint32_t kGrain = 8192;

template <class Visit>
void for_all_in_parallel(std::uint32_t count, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, kGrain), [&](const tbb::blocked_range<std::uint32_t>& range) {
    for (std::uint32_t i = range.begin(); i < range.end(); ++i) visit(i);
  });
}

}  // namespace

TriangleGrid::TriangleGrid(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles)
    : boxes_(triangles.size()), ranges_(triangles.size()) {
  choose_frame(points);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::vector<Box> boxes(count);
  for_all_in_parallel(count, [&](std::uint32_t f) {
    const auto& [a, b, c] = triangles[f];
    boxes[f] = box_of(points[a], points[b], points[c]);
    boxes_[f] = PackedBox(boxes[f]);
  });
  choose_cube_size(boxes);
  for_all_in_parallel(count, [&](std::uint32_t f) { ranges_[f] = cubes_of(boxes[f]); });
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

void TriangleGrid::choose_cube_size(const std::vector<Box>& boxes) {
  double sum = 0;
  for (const Box& box : boxes) sum += largest_extent(box);
  const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(boxes.size(), 1)));
  cubes_per_unit_ = 1 / std::max({kCubePerExtent * mean, half_extent_ / kMaxCubeIndex, std::numeric_limits<float>::min() * 16});
}

std::uint32_t TriangleGrid::find_or_add_block(int x, int y, int z) {
  const std::uint32_t known = find_block(x, y, z);
  if (known != kNone) return known;
  const auto block = static_cast<std::uint32_t>(blocks_.size());
  blocks_.push_back({block_key(x, y, z), {}});
  if (2 * blocks_.size() > table_.size())
    grow_table();
  else
    put_into_table(blocks_.back().key, block);
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
  for (std::uint32_t block = 0; block < blocks_.size(); ++block) put_into_table(blocks_[block].key, block);
}

bool TriangleGrid::has_blocks_for(const CubeRange& range) const {
  for (int x = range.low[0] >> 2; x <= range.high[0] >> 2; ++x)
    for (int y = range.low[1] >> 2; y <= range.high[1] >> 2; ++y)
      for (int z = range.low[2] >> 2; z <= range.high[2] >> 2; ++z)
        if (find_block(x, y, z) == kNone) return false;
  return true;
}

void TriangleGrid::add_blocks_for(const CubeRange& range) {
  for (int x = range.low[0] >> 2; x <= range.high[0] >> 2; ++x)
    for (int y = range.low[1] >> 2; y <= range.high[1] >> 2; ++y)
      for (int z = range.low[2] >> 2; z <= range.high[2] >> 2; ++z) find_or_add_block(x, y, z);
}

void TriangleGrid::sort_into_cubes() {
  grow_table();
  const auto count = static_cast<std::uint32_t>(ranges_.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    if (cube_count(ranges_[f]) > kMaxCubesPerTriangle)
      set_apart(f);
    else
      add_blocks_for(ranges_[f]);
  }
  const auto for_cubes = [&](std::uint32_t f, const auto& visit) {
    const CubeRange& r = ranges_[f];
    if (cube_count(r) > kMaxCubesPerTriangle) return;
    for (int x = r.low[0]; x <= r.high[0]; ++x)
      for (int y = r.low[1]; y <= r.high[1]; ++y)
        for (int z = r.low[2]; z <= r.high[2]; ++z)
          visit(std::size_t{find_block(x >> 2, y >> 2, z >> 2)} * kCubesPerBlock + static_cast<std::size_t>(cube_in_block(x, y, z)));
  };
  const std::size_t cubes = blocks_.size() * kCubesPerBlock;
  // Counted and filled by all threads at once; the order within a cube is any, and no decision depends on it.
  std::vector<std::uint32_t> next(cubes, 0);
  for_all_in_parallel(count, [&](std::uint32_t f) {
    for_cubes(f, [&](std::size_t cube) { std::atomic_ref(next[cube]).fetch_add(1, std::memory_order_relaxed); });
  });
  cube_begin_.assign(cubes + 1, 0);
  for (std::size_t i = 0; i < cubes; ++i) {
    cube_begin_[i + 1] = cube_begin_[i] + next[i];
    next[i] = cube_begin_[i];
  }
  entries_.resize(cube_begin_.back());
  for_all_in_parallel(count, [&](std::uint32_t f) {
    for_cubes(f, [&](std::size_t cube) { entries_[std::atomic_ref(next[cube]).fetch_add(1, std::memory_order_relaxed)] = f; });
  });
  added_head_.assign(cubes, kNone);
}

void TriangleGrid::set_apart(std::uint32_t f) {
  large_.push_back(f);
  ranges_[f] = {{kApart, kApart, kApart}, {32767, 32767, 32767}};  // contains every range: never extended again
}

void TriangleGrid::list(std::uint32_t f, int x, int y, int z) {
  const std::uint32_t block = find_or_add_block(x >> 2, y >> 2, z >> 2);
  const std::size_t cube = std::size_t{block} * kCubesPerBlock + static_cast<std::size_t>(cube_in_block(x, y, z));
  if (cube >= added_head_.size()) {
    added_head_.resize(blocks_.size() * kCubesPerBlock, kNone);
    cube_begin_.resize(blocks_.size() * kCubesPerBlock + 1, static_cast<std::uint32_t>(entries_.size()));
  }
  std::vector<AddedEntry>& added = blocks_[block].added;
  added.push_back({f, added_head_[cube]});
  added_head_[cube] = static_cast<std::uint32_t>(added.size() - 1);
}

void TriangleGrid::extend(std::uint32_t f, const CubeRange& range) {
  const CubeRange listed = ranges_[f], all = united(listed, range);
  if (cube_count(all) > kMaxCubesPerTriangle) return set_apart(f);
  for (int x = all.low[0]; x <= all.high[0]; ++x) {
    for (int y = all.low[1]; y <= all.high[1]; ++y) {
      for (int z = all.low[2]; z <= all.high[2]; ++z) {
        const bool is_listed = x >= listed.low[0] && x <= listed.high[0] && y >= listed.low[1] && y <= listed.high[1] &&
                               z >= listed.low[2] && z <= listed.high[2];
        if (!is_listed) list(f, x, y, z);
      }
    }
  }
  ranges_[f] = all;
}

}  // namespace smopt
