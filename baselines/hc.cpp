#include "baselines/hc.h"

#include <fmt/format.h>

#include "baselines/divergence_watch.h"
#include "baselines/smoothing_run.h"
#include "baselines/vertex_neighbours.h"
#include "smopt/parallel.h"

namespace smopt::baselines {
namespace {

class Smoother {
 public:
  Smoother(const TriangleMesh& mesh, const HcOptions& options)
      : neighbours_(build_neighbours(mesh)),
        options_(options),
        original_(mesh.points),
        means_(mesh.points),
        pushes_(mesh.points.size() + 1, Vec3::Zero()) {}

  /// \pre a zero stands behind the positions.
  void round(std::vector<Vec3>& points) {
    for_ranges_in_parallel(neighbours_.vertex_count(), [&](std::size_t begin, std::size_t end) { go_to_means(points, begin, end); });
    for_ranges_in_parallel(neighbours_.vertex_count(), [&](std::size_t begin, std::size_t end) { push_back(points, begin, end); });
  }

 private:
  void go_to_means(const std::vector<Vec3>& points, std::size_t begin, std::size_t end) {
    const NeighbourMeans means(neighbours_, points);
    const double alpha = options_.alpha;
    for (std::size_t v = begin; v < end; ++v) {
      if (means.exists(v)) means_[v] = means.of(v);
      for (int k = 0; k < 3; ++k) pushes_[v][k] = means_[v][k] - (alpha * original_[v][k] + (1 - alpha) * points[v][k]);
    }
  }

  void push_back(std::vector<Vec3>& points, std::size_t begin, std::size_t end) const {
    const NeighbourMeans pushes(neighbours_, pushes_);
    const double beta = options_.beta;
    for (std::size_t v = begin; v < end; ++v) {
      if (!pushes.exists(v)) continue;
      const Vec3 mean = pushes.of(v);
      for (int k = 0; k < 3; ++k) points[v][k] = means_[v][k] - (beta * pushes_[v][k] + (1 - beta) * mean[k]);
    }
  }

  VertexNeighbours neighbours_;
  HcOptions options_;
  std::vector<Vec3> original_;
  std::vector<Vec3> means_;
  std::vector<Vec3> pushes_;  ///< b of the paper, and a zero behind
};

MethodReport run_hc(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const HcOptions options{values.integer("rounds", 0), values.number("alpha", 0), values.number("beta", 0)};
  MethodReport report;
  const auto diverged = timed(report.seconds, "smoothing", [&] { return smooth_hc(mesh, options, progress); });
  report_rounds(report, mesh, options.rounds, diverged);
  return report;
}

}  // namespace

std::optional<int> smooth_hc(TriangleMesh& mesh, const HcOptions& options, const ProgressCallback& progress) {
  DivergenceWatch watch(mesh.points);
  Smoother smoother(mesh, options);
  std::vector<Vec3> points = with_zero_behind(mesh.points);
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    smoother.round(points);
    watch.look(std::span(points).first(mesh.points.size()), round);
  }
  mesh.points.assign(points.begin(), points.end() - 1);
  return watch.first_bad_step();
}

Method hc_method() {
  using Kind = MethodOption::Kind;
  const HcOptions defaults;
  return {
      "hc",
      "Laplacian smoothing with the vertices pushed back towards where they were",
      "Vollmer, Mencl, Müller, Comput. Graph. Forum 18:131, 1999",
      CavityPolicy::keep,
      {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "sweeps over all vertices", {}},
       {"alpha", Kind::number, fmt::format("{}", defaults.alpha), "", "pushed back to the original (1) or to the last positions (0)", {}},
       {"beta", Kind::number, fmt::format("{}", defaults.beta), "", "by the vertex's own difference (1) or by its neighbours' (0)", {}}},
      run_hc,
      ""};
}

}  // namespace smopt::baselines
