#include "baselines/taubin.h"

#include <fmt/format.h>

#include <limits>

#include "baselines/divergence_watch.h"
#include "baselines/laplacian_step.h"
#include "baselines/smoothing_run.h"

namespace smopt::baselines {
namespace {

MethodReport run_taubin(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  constexpr double kAnyNumber = std::numeric_limits<double>::lowest();
  const TaubinOptions options{values.integer("rounds", 0), values.number("lambda", 0), values.number("mu", kAnyNumber)};
  MethodReport report;
  const auto diverged = timed(report.seconds, "smoothing", [&] { return smooth_taubin(mesh, options, progress); });
  report_rounds(report, mesh, options.rounds, diverged);
  return report;
}

}  // namespace

std::optional<int> smooth_taubin(TriangleMesh& mesh, const TaubinOptions& options, const ProgressCallback& progress) {
  const VertexNeighbours neighbours = build_neighbours(mesh);
  DivergenceWatch watch(mesh.points);
  std::vector<Vec3> points = with_zero_behind(mesh.points), other = points;
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    laplacian_step(neighbours, options.lambda, points, other);
    laplacian_step(neighbours, options.mu, other, points);
    watch.look(std::span(points).first(neighbours.vertex_count()), round);
  }
  mesh.points.assign(points.begin(), points.end() - 1);
  return watch.first_bad_step();
}

Method taubin_method() {
  using Kind = MethodOption::Kind;
  const TaubinOptions defaults;
  return {"taubin",
          "Taubin's low-pass filter: a Laplacian step forth and a longer one back, so that the volume is nearly kept",
          "Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995",
          CavityPolicy::keep,
          {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "rounds of two steps", {}},
           {"lambda", Kind::number, fmt::format("{}", defaults.lambda), "", "part of the way to the mean of the neighbours, forth", {}},
           {"mu", Kind::number, fmt::format("{}", defaults.mu), "", "the same, back: negative, a little larger than lambda", {}}},
          run_taubin,
          ""};
}

}  // namespace smopt::baselines
