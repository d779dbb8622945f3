#include "smopt/improve/guarded_sweeper.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace smopt {
namespace {

void add(RoundReport& round, const RoundReport& part) {
  round.moves += part.moves;
  round.stuck += part.stuck;
  round.longest_move = std::max(round.longest_move, part.longest_move);
}

}  // namespace

GuardedSweeper::GuardedSweeper(TriangleMesh& mesh, const VertexRings& rings, const MoveRules& rules)
    : rules_(rules),
      surface_(mesh, rings),
      movers_([this] { return VertexMover(surface_, rules_, GuardFactory(rules_.guard, surface_, rules_.vicinity)()); }),
      is_stuck_(mesh.vertex_count(), 0) {}

std::size_t GuardedSweeper::stuck() const {
  return static_cast<std::size_t>(std::count(is_stuck_.begin(), is_stuck_.end(), 1));
}

RoundReport GuardedSweeper::sweep(const SweepSchedule& schedule, const StepOf& step_of, const Report& report) {
  std::vector<RoundReport> of_tiles(schedule.tile_count());
  std::vector<std::vector<VertexId>> postponed(schedule.tile_count());
  for (int color = 0; color < SweepSchedule::kColors; ++color) {
    report(static_cast<double>(color) / SweepSchedule::kColors);
    const std::span<const SweepSchedule::Tile> tiles = schedule.tiles(color);
    for_each_index(tiles.size(), [&](std::size_t i) {
      const std::size_t index = schedule.index_of(tiles[i]);
      for (const std::span<const VertexId> group : tiles[i].groups)
        visit_all(group, &tiles[i].region, step_of, of_tiles[index], postponed[index]);
    });
  }
  RoundReport round;
  std::vector<VertexId> none;
  for (const std::vector<VertexId>& vertices : postponed)
    for (const VertexId& v : vertices) visit_all({&v, 1}, nullptr, step_of, round, none);
  for (const RoundReport& tile : of_tiles) add(round, tile);
  round.active = schedule.vertices().size();
  return round;
}

/// By all threads where the guard can share the surface, else by one.
template <class Work>
void GuardedSweeper::for_each_index(std::size_t count, const Work& work) {
  if (rules_.guard == GuardKind::exact) return tbb::parallel_for(std::size_t{0}, count, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void GuardedSweeper::visit_all(std::span<const VertexId> vertices, const TriangleGrid::CubeRange* region, const StepOf& step_of,
                               RoundReport& round, std::vector<VertexId>& postponed) {
  VertexMover& mover = movers_.local();
  mover.enter(vertices, region);
  for (const VertexId v : vertices) {
    if (is_stuck_[v] != 0) {
      ++round.stuck;
      continue;
    }
    const Visit outcome = mover.visit(v, step_of(v));
    if (outcome == Visit::postponed) postponed.push_back(v);
    if (outcome == Visit::refused) {
      is_stuck_[v] = 1;
      ++round.moves.refused;
    }
    if (outcome != Visit::moved && outcome != Visit::moved_shortened) continue;
    for (const VertexId w : surface_.rings.vertices(v)) is_stuck_[w] = 0;
    ++round.moves.accepted;
    round.moves.shortened += outcome == Visit::moved_shortened ? 1 : 0;
    round.longest_move = std::max(round.longest_move, mover.moved_by());
  }
}

}  // namespace smopt
