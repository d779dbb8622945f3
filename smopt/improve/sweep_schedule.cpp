#include "smopt/improve/sweep_schedule.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace smopt {
namespace {

constexpr int kBlockShift = 2;  // a block is 4 cubes along its edge
static_assert(1 << kBlockShift == TriangleGrid::kBlockEdge);
/// Tiles of 2 × 2 × 2 blocks are many, for many threads; those of 4 × 4 × 4 find more of their surroundings in the cache, which pays where the
/// mesh is larger than the cache (6 % at a million vertices).
constexpr int kSmallTileShift = kBlockShift + 1, kLargeTileShift = kBlockShift + 2;
constexpr std::size_t kLargeMesh = 400'000;  // vertices

/// The tile's colour in the upper bits, then the tile's place, then the block's place in it: sorts blocks into the order of the schedule.
using BlockKey = std::uint64_t;
constexpr int kPlaceBits = 14;
constexpr int kPlaceOffset = 1 << (kPlaceBits - 1);
constexpr int kBlockBits = 3 * (kLargeTileShift - kBlockShift);

/// The block's place in its tile, halves of halves first (Morton's curve): the next block is mostly a neighbour.
BlockKey place_in_tile(const TriangleGrid::CubeRange& cube, int tile_shift) {
  BlockKey place = 0;
  for (int bit = tile_shift - 1; bit >= kBlockShift; --bit)
    for (const std::int16_t index : cube.low) place = place << 1 | static_cast<BlockKey>(index >> bit & 1);
  return place;
}

BlockKey key_of(const TriangleGrid::CubeRange& cube, int tile_shift) {
  const int x = cube.low[0] >> tile_shift, y = cube.low[1] >> tile_shift, z = cube.low[2] >> tile_shift;
  const auto color = static_cast<BlockKey>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
  const auto place = [](int i) { return static_cast<BlockKey>(i + kPlaceOffset); };
  return color << (3 * kPlaceBits + kBlockBits) | place(x) << (2 * kPlaceBits + kBlockBits) | place(y) << (kPlaceBits + kBlockBits) |
         place(z) << kBlockBits | place_in_tile(cube, tile_shift);
}

std::size_t color_of(BlockKey key) {
  return static_cast<std::size_t>(key >> (3 * kPlaceBits + kBlockBits));
}

bool are_in_one_tile(BlockKey a, BlockKey b) {
  return a >> kBlockBits == b >> kBlockBits;
}

/// The tile and half a tile around it.
TriangleGrid::CubeRange region_of(BlockKey key, int tile_shift) {
  const int edge = 1 << tile_shift, halo = edge / 2;
  TriangleGrid::CubeRange region{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto place = static_cast<int>((key >> ((2 - axis) * kPlaceBits + kBlockBits)) & ((1 << kPlaceBits) - 1)) - kPlaceOffset;
    region.low[axis] = static_cast<std::int16_t>(std::max(place * edge - halo, -32768));
    region.high[axis] = static_cast<std::int16_t>(std::min(place * edge + edge + halo - 1, 32767));
  }
  return region;
}

/// Numbers blocks as they come.
class BlockNumbers {
 public:
  std::uint32_t operator()(BlockKey key) {
    if (keys_.empty() || key != last_key_) {
      const auto [it, is_new] = number_.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
      if (is_new) keys_.push_back(key);
      last_key_ = key;
      last_number_ = it->second;
    }
    return last_number_;
  }
  [[nodiscard]] const std::vector<BlockKey>& keys() const { return keys_; }

 private:
  std::unordered_map<BlockKey, std::uint32_t> number_;
  std::vector<BlockKey> keys_;
  BlockKey last_key_ = 0;
  std::uint32_t last_number_ = 0;
};

}  // namespace

SweepSchedule::SweepSchedule(const TriangleGrid& grid, const TriangleMesh& mesh, const std::vector<VertexId>& vertices)
    : vertices_(vertices.size()) {
  const int tile_shift = mesh.vertex_count() < kLargeMesh ? kSmallTileShift : kLargeTileShift;
  BlockNumbers number;
  std::vector<std::uint32_t> block_of(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = mesh.points[vertices[i]];
    block_of[i] = number(key_of(grid.cubes_of(grid.box_of(p)), tile_shift));
  }
  const std::vector<BlockKey>& keys = number.keys();
  std::vector<std::uint32_t> count(keys.size(), 0), order(keys.size()), next(keys.size());
  for (const std::uint32_t block : block_of) ++count[block];
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t block = order[i];
    if (i == 0 || !are_in_one_tile(keys[order[i - 1]], keys[block])) {
      tiles_.push_back({region_of(keys[block], tile_shift), {}});
      ++color_begin_[color_of(keys[block]) + 1];
    }
    tiles_.back().groups.emplace_back(vertices_.data() + begin, count[block]);
    next[block] = begin;
    begin += count[block];
  }
  for (std::size_t color = 0; color < kColors; ++color) color_begin_[color + 1] += color_begin_[color];
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices_[next[block_of[i]]++] = vertices[i];
}

}  // namespace smopt
