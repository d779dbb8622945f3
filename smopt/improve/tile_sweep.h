#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "smopt/improve/sweep_schedule.h"

/// Used inside the library; not installed, as it needs TBB.
namespace smopt {

/// Visits the vertices of a schedule group by group, the tiles of one colour on all threads at once; what had to wait comes at the end, one by one
/// on one thread.
/// \param visit_group  called as visit_group(vertices, region, tile, postponed): visits the vertices, keeping to the region (null: the whole
///                     surface), and appends those that have to wait; `tile` is the tile's index, or tile_count() for what had to wait.
/// \param report       told the fraction that is done, at each colour.
template <class VisitGroup, class Report>
void sweep_tiles(const SweepSchedule& schedule, bool is_parallel, const VisitGroup& visit_group, const Report& report) {
  std::vector<std::vector<VertexId>> postponed(schedule.tile_count());
  for (int color = 0; color < SweepSchedule::kColors; ++color) {
    report(static_cast<double>(color) / SweepSchedule::kColors);
    const std::span<const SweepSchedule::Tile> tiles = schedule.tiles(color);
    const auto visit_tile = [&](std::size_t i) {
      const std::size_t index = schedule.index_of(tiles[i]);
      for (const std::span<const VertexId> group : tiles[i].groups) visit_group(group, &tiles[i].region, index, postponed[index]);
    };
    if (is_parallel) {
      tbb::parallel_for(std::size_t{0}, tiles.size(), visit_tile);
    } else {
      for (std::size_t i = 0; i < tiles.size(); ++i) visit_tile(i);
    }
  }
  std::vector<VertexId> none;
  for (const std::vector<VertexId>& vertices : postponed)
    for (const VertexId& v : vertices)
      visit_group(std::span(&v, 1), static_cast<const TriangleGrid::CubeRange*>(nullptr), schedule.tile_count(), none);
}

}  // namespace smopt
