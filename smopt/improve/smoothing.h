#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/improve/move_guard.h"
#include "smopt/improve/round_report.h"
#include "smopt/improve/step_rule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt {

/// When the steps of a sweep are proposed; they are made one by one, in the order of `SweepSchedule`, either way.
enum class SweepOrder {
  gauss_seidel,  ///< each from where its neighbours are by then; the paper's
  jacobi         ///< all from where the sweep began
};

/// How the surface is smoothed; the defaults are the paper's where it gives one.
struct SmoothingOptions {
  int rounds = 100;                    ///< sweeps in all, the first over every vertex; ≥ 0; the paper's default
  int rounds_per_screening = 4;        ///< sweeps over the active vertices before they are chosen anew; ≥ 1; the paper: "three or four"
  QualityThresholds thresholds;        ///< which triangles are smoothed again; the paper gives no number, these reproduce its figures
  int halvings = 10;                   ///< how often a refused step is halved before the vertex stays; ≥ 0; the paper has no bound
  StepRule step = StepRule::umbrella;  ///< the paper's
  SweepOrder order = SweepOrder::gauss_seidel;
  GuardKind guard = GuardKind::exact;  ///< the others guarantee nothing and use one thread
  int vicinity = 2;                    ///< rings of triangles that the paper's guard looks at; ≥ 1; the paper gives no number
  /// Whether a step is refused (and halved) when it would leave the star with an angle below the threshold and smaller than its smallest
  /// was. Not in the paper. Without it, repeated steps draw thin necks of the surface out into needles of hundredths of a degree, which
  /// never leave the active set and which TetGen does not mesh.
  bool keeps_angles = true;
};

struct SmoothingReport {
  std::vector<RoundReport> rounds;
  MoveCounts moves;             ///< over all rounds
  std::size_t stuck = 0;        ///< vertices whose last move was refused and whose ring has not moved since
  std::size_t low_quality = 0;  ///< triangles below the thresholds when it stopped (of those screened last)
  std::string stopped_because;  ///< "quality reached", "nothing moved" or "rounds"
};

/// Moves each vertex towards the mean of its neighbours, as far as no two triangles come to intersect.
///
/// Modified Laplacian smoothing (Liu et al. 2017, section 0.3, algorithm 3): one sweep over all vertices, then sweeps over the corners of
/// low-quality triangles and their neighbours, which are chosen anew every few sweeps. The step starts whole and is halved while
/// the guard refuses the move, or while it would make a bad angle worse (`keeps_angles`). Vertices are visited in the order of `SweepSchedule`. A
/// vertex that is refused leaves the active set until a vertex of its ring moves. It ends when no low-quality triangle is left, when all rounds
/// are used, or with a round in which a newly chosen active set did not move at all.
/// A step below 1e-7 of the longest edge at the vertex is not made: a fixed point would be approached for ever.
/// Connectivity does not change; with the exact guard, no pair of triangles intersects afterwards that did not before.
///
/// \param mesh  positions in Å, changed in place.
/// \pre mesh is a closed, oriented manifold (see `check_validity`).
/// \throws InvalidOption for an option out of its range; InvalidMesh when the mesh has no rings; Cancelled when `progress` asks for it.
/// Cost: some microseconds a move, after an O(n) build of the spatial index; all cores of the TBB arena, the same bytes for any number.
SmoothingReport smooth(TriangleMesh& mesh, const SmoothingOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt
