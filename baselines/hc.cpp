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
      : neighbours_(build_neighbours(mesh)), options_(options), original_(mesh.points), means_(mesh.points), pushes_(mesh.points.size()) {}

  void round(std::vector<Vec3>& points) {
    for_ranges_in_parallel(points.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) go_to_mean(v, points);
    });
    for_ranges_in_parallel(points.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) points[v] = pushed_back(v);
    });
  }

 private:
  void go_to_mean(std::size_t v, const std::vector<Vec3>& points) {
    const auto ring = neighbours_[v];
    if (!ring.empty()) means_[v] = neighbour_mean(ring, points);
    pushes_[v] = means_[v] - (options_.alpha * original_[v] + (1 - options_.alpha) * points[v]);
  }

  [[nodiscard]] Vec3 pushed_back(std::size_t v) const {
    const auto ring = neighbours_[v];
    if (ring.empty()) return means_[v];
    return means_[v] - (options_.beta * pushes_[v] + (1 - options_.beta) * neighbour_mean(ring, pushes_));
  }

  VertexNeighbours neighbours_;
  HcOptions options_;
  std::vector<Vec3> original_;
  std::vector<Vec3> means_;   ///< of a vertex without neighbours: its place
  std::vector<Vec3> pushes_;  ///< b of the paper
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
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    smoother.round(mesh.points);
    watch.look(mesh.points, round);
  }
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
