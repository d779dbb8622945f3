#include "baselines/iso2mesh/iso2mesh_method.h"

#include <fmt/format.h>

#include <array>

#include "baselines/iso2mesh/resample.h"
#include "baselines/iso2mesh/smoothsurf.h"
#include "baselines/smoothing_run.h"
#include "baselines/vertex_target.h"
#include "smopt/mesh/validity.h"

namespace smopt::baselines {
namespace {

using Kind = MethodOption::Kind;

SmoothsurfMethod parse_smoother(const std::string& text) {
  if (text == "lowpass") return SmoothsurfMethod::lowpass;
  return text == "laplacianhc" ? SmoothsurfMethod::laplacianhc : SmoothsurfMethod::laplacian;
}

/// What to tell of the resampling.
std::string resampling_note(const ResampleReport& report, std::size_t target, bool is_closed) {
  if (target >= report.vertices_before)
    return fmt::format("not resampled: {} vertices were asked for, and the mesh has {}", target, report.vertices_before);
  std::string note = fmt::format("resampled from {} to {} vertices", report.vertices_before, report.vertices_after);
  if (report.merged_vertices > 0) note += fmt::format(", {} that rounding had made equal merged", report.merged_vertices);
  if (!is_closed) note += "; the mesh is not closed any more";
  if (!report.is_target_met) note += fmt::format("; {} were asked for", target);
  return note;
}

ResampleOptions parse_resampling(const OptionValues& values) {
  ResampleOptions options;
  options.vertices = vertex_target(values).value_or(0);
  options.placement = values.text("placement") == "midpoint" ? CollapsePlacement::midpoint : CollapsePlacement::lindstrom_turk;
  options.digits = values.integer("resample-digits", 0);
  return options;
}

MethodReport run_iso2mesh(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const SmoothsurfOptions smoothing{parse_smoother(values.text("smoother")), values.integer("rounds", 0), values.number("alpha", 0)};
  const ResampleOptions resampling = parse_resampling(values);
  MethodReport report;
  if (resampling.vertices > 0) {
    const ResampleReport resampled = timed(report.seconds, "resampling", [&] { return resample(mesh, resampling, progress); });
    const bool is_closed = resampled.merged_vertices == 0 || check_validity(mesh).is_closed_manifold();  // collapses alone keep it closed
    report.notes.push_back(resampling_note(resampled, resampling.vertices, is_closed));
  }
  const auto diverged = timed(report.seconds, "smoothing", [&] { return smoothsurf(mesh, smoothing, progress); });
  report_rounds(report, mesh, smoothing.rounds, diverged);
  return report;
}

std::vector<MethodOption> iso2mesh_options() {
  const SmoothsurfOptions smoothing;
  std::vector<MethodOption> options = vertex_target_options();
  const std::array<MethodOption, 5> own = {{
      {"placement",
       Kind::choice,
       "midpoint",
       "",
       "of the resampling: the shortest edge to its midpoint, or Lindstrom-Turk",
       {"midpoint", "lindstrom-turk"}},
      {"resample-digits",
       Kind::integer,
       fmt::format("{}", ResampleOptions().digits),
       "",
       "significant digits of a resampled mesh's positions (ISO2mesh's own text file); 0: not rounded",
       {}},
      {"smoother", Kind::choice, "laplacian", "", "the method of smoothsurf", {"laplacian", "lowpass", "laplacianhc"}},
      {"alpha", Kind::number, fmt::format("{}", smoothing.alpha), "", "of smoothsurf", {}},
      {"rounds", Kind::integer, fmt::format("{}", smoothing.rounds), "", "of smoothsurf; the paper: 100", {}},
  }};
  options.insert(options.end(), own.begin(), own.end());
  return options;
}

}  // namespace

Method iso2mesh_method() {
  return {"iso2mesh",
          "ISO2mesh: resampling to a number of vertices by edge collapse, then smoothing without any test",
          "Fang, Boas, Tetrahedral mesh generation from volumetric binary and gray-scale images, IEEE ISBI 2009; its meshresample and "
          "smoothsurf",
          CavityPolicy::keep,
          iso2mesh_options(),
          run_iso2mesh,
          "nothing is resampled unless --vertices or --match asks for it; meshcheckrepair, which starts repair programs of its own, is "
          "left out"};
}

}  // namespace smopt::baselines
