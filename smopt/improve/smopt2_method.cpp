#include <fmt/format.h>

#include <cmath>

#include "smopt/error.h"
#include "smopt/improve/method.h"
#include "smopt/improve/projection.h"
#include "smopt/improve/remesh/remesh.h"
#include "smopt/improve/remesh/two_sided_distance.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/orientation.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/gaussian_surface.h"
#include "smopt/surface/positive_option.h"

namespace smopt {
namespace {

using Kind = MethodOption::Kind;

/// How exactly the distance to the input is measured, in parts of the bound that was asked for.
constexpr double kMeasuringToleranceRel = 0.001;

/// How often vertices are brought onto the level set; repairs, which follow, take some off it again, in the end hardly any.
constexpr int kProjections = 3;

std::string text_of(double value) {
  return fmt::format("{}", value);
}

MethodOption on_off(std::string name, bool is_on, std::string help) {
  return {std::move(name), Kind::choice, is_on ? "on" : "off", "", std::move(help), {"on", "off"}};
}

std::vector<MethodOption> goal_options() {
  const RemeshGoals goals;
  return {
      {"min-angle", Kind::number, text_of(goals.min_angle_deg), "degrees", "goal: no smaller angle", {}},
      {"max-angle", Kind::number, text_of(goals.max_angle_deg), "degrees", "goal: no larger angle", {}},
      {"edge-ratio", Kind::number, text_of(goals.edge_ratio), "", "goal: no triangle whose shortest/longest edge is below", {}},
      {"min-dihedral",
       Kind::number,
       text_of(goals.min_dihedral_deg),
       "degrees",
       "goal: no sharper angle between neighbouring triangles",
       {}},
      {"valence", Kind::integer, text_of(goals.valence_spread), "", "goal: valences are 6 give or take this", {}},
  };
}

std::vector<MethodOption> smopt2_options() {
  const RemeshOptions remeshing;
  const GaussianFieldOptions field;
  const GaussianSurfaceOptions surface;
  std::vector<MethodOption> options = goal_options();
  const std::vector<MethodOption> others = {
      {"deviation",
       Kind::number,
       "0",
       "Å",
       "no point of input (without its cavities) or output is farther than this from the other: enforced; 0: no bound",
       {}},
      {"sizing",
       Kind::choice,
       "density",
       "",
       "edges as long as the input's around there, alike everywhere, or fit for the curvature",
       {"density", "uniform", "curvature"}},
      {"vertices", Kind::integer, "0", "", "about so many vertices; 0: as many as the input, or as --edge-length or --error ask for", {}},
      {"edge-length", Kind::number, "0", "Å", "length of the edges with --sizing uniform; 0: by the number of vertices", {}},
      {"error",
       Kind::number,
       text_of(remeshing.chord_error),
       "Å",
       "with --sizing curvature: about how far chords are to be off the surface",
       {}},
      {"rounds",
       Kind::integer,
       text_of(remeshing.rounds),
       "",
       "of splits, collapses, flips and relaxation; some more while the number of vertices is off",
       {}},
      {"repairs", Kind::integer, text_of(remeshing.repairs), "", "sweeps over what misses a goal, at most, each time", {}},
      {"refinements",
       Kind::integer,
       text_of(remeshing.refinements),
       "",
       "how often edges are made shorter where triangles miss a goal",
       {}},
      on_off("flips", remeshing.flips, "flip edges"),
      on_off("collapses", remeshing.collapses, "collapse edges"),
      on_off("splits", remeshing.splits, "split edges"),
      {"volume", Kind::choice, "preserve", "", "the enclosed volume is kept, or vertices go where they like", {"preserve", "ignore"}},
      {"molecule", Kind::text, "", "", "file of the molecule: vertices are brought onto its Gaussian surface", {}},
      {"decay", Kind::number, text_of(field.decay), "1/Å²", "of the Gaussian surface of --molecule", {}},
      {"isovalue", Kind::number, text_of(surface.isovalue), "", "of the Gaussian surface of --molecule", {}},
  };
  options.insert(options.end(), others.begin(), others.end());
  return options;
}

Sizing parse_sizing(const std::string& text) {
  if (text == "uniform") return Sizing::uniform;
  return text == "curvature" ? Sizing::curvature : Sizing::density;
}

RemeshOptions parse(const OptionValues& values) {
  RemeshOptions options;
  options.goals = {values.number("min-angle", 0), values.number("max-angle", 0), values.number("edge-ratio", 0),
                   values.number("min-dihedral", 0), values.integer("valence", 0)};
  if (const double deviation = values.number("deviation", 0); deviation > 0) options.deviation = deviation;
  options.sizing = parse_sizing(values.text("sizing"));
  options.vertices = static_cast<std::size_t>(values.integer("vertices", 0));
  options.edge_length = values.number("edge-length", 0);
  if (options.edge_length > 0 && options.sizing != Sizing::uniform) throw InvalidOption("edge-length: needs --sizing uniform");
  if (options.edge_length > 0 && options.vertices > 0) throw InvalidOption("edge-length: not together with --vertices");
  options.chord_error = values.number("error", 0);
  if (options.chord_error != RemeshOptions().chord_error && options.sizing != Sizing::curvature)
    throw InvalidOption("error: needs --sizing curvature");
  options.rounds = values.integer("rounds", 0);
  options.repairs = values.integer("repairs", 0);
  options.refinements = values.integer("refinements", 0);
  options.flips = values.text("flips") == "on";
  options.collapses = values.text("collapses") == "on";
  options.splits = values.text("splits") == "on";
  options.preserves_volume = values.text("volume") == "preserve";
  return options;
}

/// Vertices go onto the level set, then what that made miss a goal is repaired, and so on.
RemeshReport remesh_onto_level_set(TriangleMesh& mesh, const RemeshOptions& options, const OptionValues& values, MethodReport& notes,
                                   const ProgressCallback& progress) {
  GaussianFieldOptions field_options;
  field_options.decay = values.number("decay", 0);
  const double isovalue = values.number("isovalue", 0);
  const GaussianField field(read_molecule(values.text("molecule")), field_options);
  RemeshOptions repairs = options;
  repairs.rounds = 0;
  repairs.preserves_volume = false;  // the level set's volume is what is wanted now
  ProjectionOptions projection;
  projection.min_angle_deg = options.goals.min_angle_deg;
  RemeshReport report = remesh(mesh, options, progress);
  for (int i = 0; i < kProjections; ++i) {
    const ProjectionReport projected = project_onto_level_set(mesh, field, isovalue, projection, progress);
    report.moves += projected.moves;
    if (i + 1 == kProjections)
      notes.notes.push_back(
          fmt::format("before the last repairs, {} of {} vertices were on the level set", projected.arrived, mesh.vertex_count()));
    report.append(remesh(mesh, repairs, progress));
  }
  return report;
}

void add_notes(MethodReport& report, const RemeshReport& remeshed) {
  if (remeshed.refinements > 0)
    report.notes.push_back(fmt::format("edges were made shorter {} times where nothing else helped", remeshed.refinements));
  report.notes.push_back(fmt::format("{} flips, {} collapses, {} splits made; {}, {} and {} refused", remeshed.flips.done,
                                     remeshed.collapses.done, remeshed.splits.done, remeshed.flips.refused, remeshed.collapses.refused,
                                     remeshed.splits.refused));
  for (const GoalOutcome& goal : remeshed.goals) {
    if (goal.missing == 0) continue;
    report.notes.push_back(
        fmt::format("goal not reached: {} {:.4g}, the worst {:.4g}; {}", goal.name, goal.goal, goal.reached, goal.explanation));
  }
}

/// Measured, whatever was enforced.
void add_distance(MethodReport& report, const TriangleMesh& input, const TriangleMesh& output, double bound) {
  const TwoSidedDistance distance = two_sided_distance(input, output, kMeasuringToleranceRel * bound);
  report.deviation = MethodReport::Deviation{distance.lower(), distance.upper()};
  report.notes.push_back(
      fmt::format("measured distance of input and output: between {:.4g} and {:.4g} Å; proved on the way: at most {:.4g} Å",
                  distance.lower(), distance.upper(), bound));
}

MethodReport run_smopt2(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const RemeshOptions options = parse(values);
  require_positive(values.number("decay", 0), "decay");
  require_positive(values.number("isovalue", 0), "isovalue");
  const bool has_molecule = !values.text("molecule").empty(), has_bound = std::isfinite(options.deviation);
  if (has_molecule && has_bound)
    throw InvalidOption("deviation: no bound on the distance to the input with --molecule, whose surface counts");
  MethodReport report;
  const TriangleMesh input = has_bound ? mesh : TriangleMesh{};
  report.volume_before = signed_volume(mesh);
  const RemeshReport remeshed = timed(report.seconds, "smoothing", [&] {
    return has_molecule ? remesh_onto_level_set(mesh, options, values, report, progress) : remesh(mesh, options, progress);
  });
  report.volume_after = signed_volume(mesh);
  report.rounds_run = static_cast<std::size_t>(remeshed.rounds + remeshed.repairs);
  report.moves = remeshed.moves;
  report.operations = {{"flips", remeshed.flips}, {"collapses", remeshed.collapses}, {"splits", remeshed.splits}};
  report.goals = remeshed.goals;
  report.stopped_because = remeshed.stopped_because;
  add_notes(report, remeshed);
  if (has_bound) timed(report.seconds, "measuring", [&] { add_distance(report, input, mesh, options.deviation); });
  return report;
}

}  // namespace

void register_smopt2(MethodRegistry& registry) {
  registry.add(
      {"smopt2",
       "regular triangles everywhere by splits, collapses, flips and relaxation that never let two triangles intersect; keeps the volume",
       "the guard of smopt; Botsch, Kobbelt, SGP 2004; Hu, Yan, Bommes, Alliez, Benes, IEEE TVCG 23:2560, 2017",
       CavityPolicy::delete_cavities, smopt2_options(), run_smopt2, "connectivity changes; `smopt --step volume-preserving` keeps it"});
}

}  // namespace smopt
