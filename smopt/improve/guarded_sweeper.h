#pragma once

#include <functional>
#include <span>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "smopt/improve/guarded_surface.h"
#include "smopt/improve/round_report.h"
#include "smopt/improve/sweep_schedule.h"
#include "smopt/improve/vertex_mover.h"

/// Used inside the library; not installed, as it needs TBB.
namespace smopt {

/// Sweeps over the vertices of a surface, each of which makes a step as far as the guard lets it.
///
/// The tiles of one colour are worked on by all threads at once (by one, where the guard cannot share the surface); what had to wait comes at the
/// end. A vertex that is refused is passed over until a vertex of its ring moves.
class GuardedSweeper {
 public:
  /// The step that a vertex wants to make from where it is, Å; asked from several threads.
  using StepOf = std::function<Vec3(VertexId)>;
  /// Told the fraction of a sweep that is done.
  using Report = std::function<void(double)>;

  /// \pre the surface outlives the sweeper and changes only through it.
  GuardedSweeper(GuardedSurface& surface, const MoveRules& rules);

  [[nodiscard]] SweepSchedule schedule(const std::vector<VertexId>& vertices) const { return {surface_.grid, surface_.mesh, vertices}; }
  RoundReport sweep(const SweepSchedule& schedule, const StepOf& step_of, const Report& report);
  /// Vertices whose last move was refused and whose ring has not moved since.
  [[nodiscard]] std::size_t stuck() const;

 private:
  void visit_all(std::span<const VertexId> vertices, const TriangleGrid::CubeRange* region, const StepOf& step_of, RoundReport& round,
                 std::vector<VertexId>& postponed);

  MoveRules rules_;
  GuardedSurface& surface_;
  tbb::enumerable_thread_specific<VertexMover> movers_;
  std::vector<char> is_stuck_;  // per vertex
};

}  // namespace smopt
