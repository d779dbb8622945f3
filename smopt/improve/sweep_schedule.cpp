#include "smopt/improve/sweep_schedule.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace smopt {
namespace {

constexpr int kTileShift = 3;  // a tile is 8 cubes, two grid blocks, along its edge
constexpr int kTileEdge = 1 << kTileShift;
constexpr int kHalo = TriangleGrid::kBlockEdge;  // half a tile
static_assert(2 * kHalo == kTileEdge && kTileEdge % TriangleGrid::kBlockEdge == 0);

/// The tile's colour in the upper bits, then the tile's place, then the block's place in it: sorts blocks into the order of the schedule.
using BlockKey = std::uint64_t;
constexpr int kPlaceBits = 14;
constexpr int kPlaceOffset = 1 << (kPlaceBits - 1);
constexpr int kBlockBits = 3;

BlockKey key_of(const TriangleGrid::CubeRange& cube) {
  const int x = cube.low[0] >> kTileShift, y = cube.low[1] >> kTileShift, z = cube.low[2] >> kTileShift;
  const auto color = static_cast<BlockKey>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
  const auto place = [](int i) { return static_cast<BlockKey>(i + kPlaceOffset); };
  const auto half = [&cube](int axis) { return static_cast<BlockKey>(cube.low[axis] >> (kTileShift - 1) & 1); };
  return color << (3 * kPlaceBits + kBlockBits) | place(x) << (2 * kPlaceBits + kBlockBits) | place(y) << (kPlaceBits + kBlockBits) |
         place(z) << kBlockBits | half(0) << 2 | half(1) << 1 | half(2);
}

std::size_t color_of(BlockKey key) {
  return static_cast<std::size_t>(key >> (3 * kPlaceBits + kBlockBits));
}

bool are_in_one_tile(BlockKey a, BlockKey b) {
  return a >> kBlockBits == b >> kBlockBits;
}

TriangleGrid::CubeRange region_of(BlockKey key) {
  TriangleGrid::CubeRange region{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto place = static_cast<int>((key >> ((2 - axis) * kPlaceBits + kBlockBits)) & ((1 << kPlaceBits) - 1)) - kPlaceOffset;
    region.low[axis] = static_cast<std::int16_t>(std::max(place * kTileEdge - kHalo, -32768));
    region.high[axis] = static_cast<std::int16_t>(std::min(place * kTileEdge + kTileEdge + kHalo - 1, 32767));
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
  BlockNumbers number;
  std::vector<std::uint32_t> block_of(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = mesh.points[vertices[i]];
    block_of[i] = number(key_of(grid.cubes_of(grid.box_of(p, p))));
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
      tiles_.push_back({region_of(keys[block]), {}});
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
