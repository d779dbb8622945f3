#include "baselines/smoothing_run.h"

#include <fmt/format.h>

namespace smopt::baselines {

void report_rounds(MethodReport& report, const TriangleMesh& mesh, int rounds, const DivergenceWatch& watch) {
  report.rounds.assign(static_cast<std::size_t>(rounds), {mesh.vertex_count(), {mesh.vertex_count(), 0, 0}, 0});
  report.moves.accepted = mesh.vertex_count() * static_cast<std::size_t>(rounds);
  report.diverged_at_step = watch.first_bad_step();
  report.stopped_because = report.diverged_at_step ? fmt::format("diverged at step {}", *report.diverged_at_step) : "rounds";
}

}  // namespace smopt::baselines
