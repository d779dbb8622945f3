#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/improve/improve.h"
#include "smopt/improve/method.h"

namespace smopt {
namespace {

using Kind = MethodOption::Kind;

/// The options; numbers have the defaults of the library's own structs (the tolerance is text, as it may end in "rel").
std::vector<MethodOption> smopt_options() {
  const SmoothingOptions smoothing;
  const auto text = [](auto value) { return fmt::format("{}", value); };
  return {
      {"rounds", Kind::integer, text(smoothing.rounds), "", "sweeps of smoothing; 0: cavities and redundant points only", {}},
      {"rounds-per-screening",
       Kind::integer,
       text(smoothing.rounds_per_screening),
       "",
       "sweeps between two choices of the active vertices",
       {}},
      {"edge-ratio",
       Kind::number,
       text(smoothing.thresholds.edge_ratio),
       "",
       "smooth triangles again whose shortest/longest edge is below",
       {}},
      {"min-angle",
       Kind::number,
       text(smoothing.thresholds.min_angle_deg),
       "degrees",
       "smooth triangles again that have an angle below",
       {}},
      {"halvings", Kind::integer, text(smoothing.halvings), "", "how often a refused step is halved before the vertex stays", {}},
      {"step",
       Kind::choice,
       "umbrella",
       "",
       "where a vertex wants to go (umbrella: the paper's)",
       {"umbrella", "volume-preserving", "tangential"}},
      {"order",
       Kind::choice,
       "gauss-seidel",
       "",
       "steps are proposed one by one (gauss-seidel: the paper's) or all from where the sweep began (jacobi)",
       {"gauss-seidel", "jacobi"}},
      {"guard",
       Kind::choice,
       "exact",
       "",
       "exact: the whole surface; paper: the paper's test of the neighbourhood; none; the last two guarantee nothing",
       {"exact", "paper", "none"}},
      {"vicinity", Kind::integer, text(smoothing.vicinity), "rings", "how far --guard paper looks", {}},
      {"bad-angles",
       Kind::choice,
       smoothing.keeps_angles ? "keep" : "ignore",
       "",
       "keep: refuse a step that makes an angle below --min-angle worse; ignore: the paper's",
       {"keep", "ignore"}},
      {"redundant", Kind::choice, "delete", "", "points of valence 3 and 4 on their ring's plane or diagonal", {"delete", "keep"}},
      {"tolerance", Kind::text, "1e-4", "Å", "distance below which a point is redundant; '1e-3rel' is relative to the local edge", {}},
  };
}

StepRule parse_step(const std::string& text) {
  if (text == "volume-preserving") return StepRule::volume_preserving;
  return text == "tangential" ? StepRule::tangential : StepRule::umbrella;
}

GuardKind parse_guard(const std::string& text) {
  if (text == "paper") return GuardKind::paper;
  return text == "none" ? GuardKind::none : GuardKind::exact;
}

RedundantPointOptions parse_tolerance(const OptionValues& values) {
  constexpr std::string_view kRelative = "rel";
  std::string text = values.text("tolerance");
  RedundantPointOptions options;
  options.is_tolerance_relative = text.ends_with(kRelative);
  if (options.is_tolerance_relative) text.resize(text.size() - kRelative.size());
  const std::vector<MethodOption> number = {{"tolerance", Kind::number, text, "", "", {}}};
  options.tolerance = OptionValues(number, {}).number("tolerance", 0);
  return options;
}

SmoothingOptions parse_smoothing(const OptionValues& values) {
  SmoothingOptions options;
  options.rounds = values.integer("rounds", 0);
  options.rounds_per_screening = values.integer("rounds-per-screening", 1);
  options.thresholds = {values.number("edge-ratio", 0), values.number("min-angle", 0)};
  options.halvings = values.integer("halvings", 0);
  options.keeps_angles = values.text("bad-angles") == "keep";
  options.step = parse_step(values.text("step"));
  options.order = values.text("order") == "jacobi" ? SweepOrder::jacobi : SweepOrder::gauss_seidel;
  options.guard = parse_guard(values.text("guard"));
  options.vicinity = values.integer("vicinity", 1);
  return options;
}

MethodReport run_smopt(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  ImproveOptions options;
  options.deletes_redundant_points = values.text("redundant") == "delete";
  options.redundant = parse_tolerance(values);
  options.smoothing = parse_smoothing(values);
  ImproveReport improved;
  improve_prepared(mesh, options, improved, progress);
  MethodReport report;
  report.redundant_valence3 = improved.redundant.valence3;
  report.redundant_valence4 = improved.redundant.valence4;
  report.rounds = std::move(improved.smoothing.rounds);
  report.rounds_run = report.rounds.size();
  report.moves = improved.smoothing.moves;
  report.stuck = improved.smoothing.stuck;
  report.volume_before = improved.volume_before_smoothing;
  report.volume_after = improved.volume_after_smoothing;
  report.stopped_because = improved.smoothing.stopped_because;
  report.seconds = std::move(improved.seconds);
  return report;
}

}  // namespace

void register_smopt(MethodRegistry& registry) {
  registry.add({"smopt", "redundant points deleted, then Laplacian smoothing that never lets two triangles intersect",
                "Liu, Chen, Song, Li, Lu, PLoS ONE 12(9): e0184206, 2017", CavityPolicy::delete_cavities, smopt_options(), run_smopt});
}

}  // namespace smopt
