#include "smopt/improve/guarded_sweeper.h"

#include <algorithm>

#include "smopt/improve/tile_sweep.h"

namespace smopt {
namespace {

void add(RoundReport& round, const RoundReport& part) {
  round.moves += part.moves;
  round.stuck += part.stuck;
  round.longest_move = std::max(round.longest_move, part.longest_move);
}

}  // namespace

GuardedSweeper::GuardedSweeper(GuardedSurface& surface, const MoveRules& rules)
    : rules_(rules),
      surface_(surface),
      movers_([this] { return VertexMover(surface_, rules_, GuardFactory(rules_.guard, surface_, rules_.vicinity)()); }),
      is_stuck_(surface.mesh.vertex_count(), 0) {}

std::size_t GuardedSweeper::stuck() const {
  return static_cast<std::size_t>(std::count(is_stuck_.begin(), is_stuck_.end(), 1));
}

RoundReport GuardedSweeper::sweep(const SweepSchedule& schedule, const StepOf& step_of, const Report& report) {
  std::vector<RoundReport> of_tiles(schedule.tile_count() + 1);  // the last: what had to wait
  const bool is_parallel = rules_.guard == GuardKind::exact;     // the others cannot share the surface
  sweep_tiles(
      schedule, is_parallel,
      [&](std::span<const VertexId> group, const TriangleGrid::CubeRange* region, std::size_t tile, std::vector<VertexId>& postponed) {
        visit_all(group, region, step_of, of_tiles[tile], postponed);
      },
      report);
  RoundReport round;
  for (const RoundReport& tile : of_tiles) add(round, tile);
  round.active = schedule.vertices().size();
  return round;
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
