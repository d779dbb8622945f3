#include "smopt/improve/sweep_schedule.h"

#include <algorithm>
#include <unordered_map>

namespace smopt {
namespace {

constexpr int kTileShift = 3;  // a tile is 8 cubes, two grid blocks, along its edge
constexpr int kTileEdge = 1 << kTileShift;
constexpr int kHalo = TriangleGrid::kBlockEdge;  // half a tile
static_assert(2 * kHalo == kTileEdge && kTileEdge % TriangleGrid::kBlockEdge == 0);

/// Colour in the upper bits, then the tile's place: sorts tiles into the order of the schedule.
using TileKey = std::uint64_t;
constexpr int kPlaceBits = 14;
constexpr int kPlaceOffset = 1 << (kPlaceBits - 1);

TileKey key_of(const TriangleGrid::CubeRange& cube) {
  const int x = cube.low[0] >> kTileShift, y = cube.low[1] >> kTileShift, z = cube.low[2] >> kTileShift;
  const auto color = static_cast<TileKey>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
  const auto place = [](int i) { return static_cast<TileKey>(i + kPlaceOffset); };
  return color << (3 * kPlaceBits) | place(x) << (2 * kPlaceBits) | place(y) << kPlaceBits | place(z);
}

int color_of(TileKey key) {
  return static_cast<int>(key >> (3 * kPlaceBits));
}

TriangleGrid::CubeRange region_of(TileKey key) {
  TriangleGrid::CubeRange region{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto place = static_cast<int>((key >> ((2 - axis) * kPlaceBits)) & ((1 << kPlaceBits) - 1)) - kPlaceOffset;
    region.low[axis] = static_cast<std::int16_t>(std::max(place * kTileEdge - kHalo, -32768));
    region.high[axis] = static_cast<std::int16_t>(std::min(place * kTileEdge + kTileEdge + kHalo - 1, 32767));
  }
  return region;
}

}  // namespace

SweepSchedule::SweepSchedule(const TriangleGrid& grid, const TriangleMesh& mesh, const std::vector<VertexId>& vertices) {
  std::unordered_map<TileKey, std::uint32_t> number;
  std::vector<TileKey> keys;
  std::vector<std::uint32_t> tile_of(vertices.size()), count;
  TileKey last_key = 0;
  std::uint32_t last_tile = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = mesh.points[vertices[i]];
    const TileKey key = key_of(grid.cubes_of(grid.box_of(p, p)));
    if (keys.empty() || key != last_key) {
      const auto [it, is_new] = number.try_emplace(key, static_cast<std::uint32_t>(keys.size()));
      if (is_new) {
        keys.push_back(key);
        count.push_back(0);
      }
      last_key = key;
      last_tile = it->second;
    }
    tile_of[i] = last_tile;
    ++count[last_tile];
  }

  std::vector<std::uint32_t> order(keys.size()), next(keys.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  std::uint32_t begin = 0;
  for (const std::uint32_t tile : order) {
    tiles_.push_back({region_of(keys[tile]), begin, begin + count[tile]});
    next[tile] = begin;
    begin += count[tile];
    ++color_begin_[static_cast<std::size_t>(color_of(keys[tile])) + 1];
  }
  for (std::size_t color = 0; color < kColors; ++color) color_begin_[color + 1] += color_begin_[color];
  vertices_.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices_[next[tile_of[i]]++] = vertices[i];
}

}  // namespace smopt
