#include "baselines/gamer/angle_weighted_smoothing.h"

#include <fmt/format.h>

#include "baselines/divergence_watch.h"
#include "baselines/gamer/angle_weighted_step.h"
#include "baselines/gamer/edge_flips.h"
#include "baselines/smoothing_run.h"
#include "smopt/error.h"
#include "smopt/mesh/rings.h"

namespace smopt::baselines {
namespace {

VertexRings rings_of(const TriangleMesh& mesh) {
  std::optional<VertexRings> rings = build_rings(mesh);
  if (!rings) throw InvalidMesh("GAMer's smoothing needs a closed, oriented manifold");
  return std::move(*rings);
}

MethodReport run_gamer(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const AngleWeightedOptions options{values.integer("rounds", 0), values.integer("tensor-rings", 1), values.text("flips") == "on"};
  MethodReport report;
  const AngleWeightedReport smoothing = timed(report.seconds, "smoothing", [&] { return smooth_angle_weighted(mesh, options, progress); });
  report_rounds(report, mesh, options.rounds, smoothing.diverged_at_step);
  if (options.has_flips) report.notes.push_back(fmt::format("{} edges were flipped", smoothing.flipped_edges));
  return report;
}

}  // namespace

AngleWeightedReport smooth_angle_weighted(TriangleMesh& mesh, const AngleWeightedOptions& options, const ProgressCallback& progress) {
  AngleWeightedReport report;
  VertexRings rings = rings_of(mesh);
  DivergenceWatch watch(mesh.points);
  std::vector<Vec3> next(mesh.points.size());
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    angle_weighted_step(mesh, rings, options.tensor_rings, next);
    mesh.points.swap(next);
    watch.look(mesh.points, round);
    const std::size_t flipped = options.has_flips ? flip_edges(mesh, rings) : 0;
    if (flipped > 0) rings = rings_of(mesh);
    report.flipped_edges += flipped;
  }
  report.diverged_at_step = watch.first_bad_step();
  return report;
}

Method gamer_method() {
  using Kind = MethodOption::Kind;
  const AngleWeightedOptions defaults;
  return {
      "gamer",
      "GAMer 2's angle-weighted smoothing, damped by the local structure tensor, with edge flips",
      "Yu, Holst, Cheng & McCammon, J. Mol. Graph. Model. 26:1370, 2008; Lee et al., PLoS Comput. Biol. 16:e1007756, 2020",
      CavityPolicy::keep,
      {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "GAMer's max_iter", {}},
       {"tensor-rings", Kind::integer, fmt::format("{}", defaults.tensor_rings), "", "rings whose normals damp a move", {}},
       {"flips", Kind::choice, "on", "", "edges flipped for better angles after each round", {"on", "off"}}},
      run_gamer,
      "own implementation from the papers and GAMer 2's behaviour; ridges are not kept from flips (GAMer's preserve_ridges, off there "
      "too); "
      "edges are tried in ascending order, in GAMer in that of a hash table; a degenerate triangle is passed over where GAMer gives up"};
}

}  // namespace smopt::baselines
