#include "baselines/laplacian.h"

#include <fmt/format.h>

#include "baselines/divergence_watch.h"
#include "baselines/laplacian_step.h"
#include "baselines/smoothing_run.h"
#include "baselines/vertex_neighbours.h"

namespace smopt::baselines {
namespace {

/// One Gauss–Seidel round in ascending order.
void sweep(const VertexNeighbours& neighbours, double beta, std::vector<Vec3>& points) {
  const NeighbourMeans means(neighbours, points);
  for (std::size_t v = 0; v < neighbours.vertex_count(); ++v) {
    if (means.exists(v)) points[v] += beta * (means.of(v) - points[v]);
  }
}

MethodReport run_laplacian(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const LaplacianOptions options{values.integer("rounds", 0), values.number("beta", 0),
                                 values.text("order") == "jacobi" ? SweepOrder::jacobi : SweepOrder::gauss_seidel};
  MethodReport report;
  const auto diverged = timed(report.seconds, "smoothing", [&] { return smooth_laplacian(mesh, options, progress); });
  report_rounds(report, mesh, options.rounds, diverged);
  return report;
}

}  // namespace

std::optional<int> smooth_laplacian(TriangleMesh& mesh, const LaplacianOptions& options, const ProgressCallback& progress) {
  const VertexNeighbours neighbours = build_neighbours(mesh);
  DivergenceWatch watch(mesh.points);
  const bool may_diverge = options.beta > 1;  // up to 1 a vertex stays within the hull of its ring
  std::vector<Vec3> points = with_zero_behind(mesh.points);
  std::vector<Vec3> next = options.order == SweepOrder::jacobi ? points : std::vector<Vec3>();
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    if (options.order == SweepOrder::gauss_seidel) {
      sweep(neighbours, options.beta, points);
    } else {
      laplacian_step(neighbours, options.beta, points, next);
      points.swap(next);
    }
    if (may_diverge) watch.look(std::span(points).first(neighbours.vertex_count()), round);
  }
  mesh.points.assign(points.begin(), points.end() - 1);
  return watch.first_bad_step();
}

Method laplacian_method() {
  using Kind = MethodOption::Kind;
  const LaplacianOptions defaults;
  return {"laplacian",
          "plain Laplacian smoothing of every vertex, without any test",
          "Liu et al. 2017, equations 3 and 4; Field, Commun. Appl. Numer. Methods 4:709, 1988",
          CavityPolicy::keep,
          {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "sweeps over all vertices", {}},
           {"beta", Kind::number, fmt::format("{}", defaults.beta), "", "part of the way to the mean of the neighbours", {}},
           {"order",
            Kind::choice,
            "jacobi",
            "",
            "jacobi: from the last round's positions; gauss-seidel: moved at once",
            {"jacobi", "gauss-seidel"}}},
          run_laplacian};
}

}  // namespace smopt::baselines
