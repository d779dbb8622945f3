#pragma once

#include <array>
#include <span>
#include <vector>

#include "smopt/geometry/triangle_grid.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The order in which a sweep visits vertices, the same for any number of threads.
///
/// Space is divided into tiles of 2×2×2 grid blocks (4×4×4 for large meshes), in eight colours like a chessboard of three dimensions. A tile's
/// region is the tile and half a tile around it; regions of one colour do not overlap, so the tiles of a colour may be worked on at the same time,
/// each by one thread, block after block, in ascending order of the block's vertices. A vertex whose move would reach out of its tile's region
/// waits until the end of the sweep, when one thread does what is left, in the order of colours and tiles.
class SweepSchedule {
 public:
  struct Tile {
    TriangleGrid::CubeRange region;
    std::vector<std::span<const VertexId>> groups;  ///< the vertices of each block
  };
  static constexpr int kColors = 8;

  /// Cost: O(vertices).
  SweepSchedule(const TriangleGrid& grid, const TriangleMesh& mesh, const std::vector<VertexId>& vertices);

  [[nodiscard]] std::span<const Tile> tiles(int color) const {
    return {tiles_.data() + color_begin_[color], color_begin_[color + 1] - color_begin_[color]};
  }
  [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }
  [[nodiscard]] std::size_t index_of(const Tile& tile) const { return static_cast<std::size_t>(&tile - tiles_.data()); }
  /// In the order of the schedule.
  [[nodiscard]] const std::vector<VertexId>& vertices() const { return vertices_; }

 private:
  std::vector<Tile> tiles_;  // by colour, then by place
  std::array<std::size_t, kColors + 1> color_begin_{};
  std::vector<VertexId> vertices_;  // by tile and block
};

}  // namespace smopt
