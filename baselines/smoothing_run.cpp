#include "baselines/smoothing_run.h"

#include <fmt/format.h>

namespace smopt::baselines {

void report_rounds(MethodReport& report, const TriangleMesh& mesh, int rounds, std::optional<int> diverged_at_step) {
  report.rounds_run = static_cast<std::size_t>(rounds);
  report.moves.accepted = mesh.vertex_count() * static_cast<std::size_t>(rounds);
  report.diverged_at_step = diverged_at_step;
  report.stopped_because = diverged_at_step ? fmt::format("diverged at step {}", *diverged_at_step) : "rounds";
}

}  // namespace smopt::baselines
