#include "experiments/generate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "baselines/baselines.h"
#include "experiments/improve_run.h"
#include "experiments/run_report.h"
#include "smopt/error.h"
#include "smopt/improve/prepare.h"
#include "smopt/improve/projection.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/sha256.h"
#include "smopt/io/small_radii.h"
#include "smopt/surface/level_set_distance.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

struct ComponentsName {
  std::string_view name;
  CavityPolicy policy;
};
constexpr std::array<ComponentsName, 3> kComponents = {
    {{"all", CavityPolicy::keep}, {"outer", CavityPolicy::delete_cavities}, {"main", CavityPolicy::main}}};

std::string_view components_name(CavityPolicy policy) {
  return std::ranges::find(kComponents, policy, &ComponentsName::policy)->name;
}

Json run_options_json(const GenerateRun& run) {
  Json options = {{"decay", run.surface.decay}, {"isovalue", run.surface.isovalue}};
  if (run.surface.error > 0)
    options["error"] = run.surface.error;
  else
    options["spacing"] = run.surface.spacing;
  options["min_radius"] = run.min_radius;
  options["radii"] = radius_set_name(run.reading.radius_set);
  options["keep_waters"] = run.reading.keep_waters;
  options["components"] = components_name(run.components);
  options["improve"] = run.improve;
  options["project"] = run.project;
  options["digits"] = run.digits;
  return options;
}

Json adaptive_json(const AdaptiveSurfaceReport& adaptive) {
  return {{"surface_cells_by_level", adaptive.surface_cells},
          {"finest_edge", adaptive.finest_edge},
          {"hanging_cells", adaptive.hanging_cells},
          {"folded_cells", adaptive.folded_cells},
          {"divided",
           {{"for_error", adaptive.divided.for_error},
            {"for_balance", adaptive.divided.for_balance},
            {"for_hanging_nodes", adaptive.divided.for_hanging},
            {"for_topology", adaptive.divided.for_topology}}}};
}

Json sampling_json(const GenerateRun& run, const GaussianSurfaceReport& met) {
  Json json = {{"kind", run.surface.error > 0 ? "adaptive" : "uniform"},
               {"surface_cells", met.surface_cells},
               {"ambiguous_cells", met.ambiguous_cells},
               {"tunnel_cells", met.tunnel_cells},
               {"interior_vertices", met.interior_vertices}};
  if (run.surface.error > 0)
    json.update(adaptive_json(met.adaptive));
  else
    json["grid_nodes"] = met.grid_nodes;
  return json;
}

Json distance_json(const LevelSetDistance& distance) {
  return {{"largest", distance.largest}, {"mean", distance.mean}, {"unresolved", distance.unresolved}};
}

Json projection_json(const ProjectionReport& projection) {
  return {{"rounds", projection.rounds},
          {"arrived", projection.arrived},
          {"moves",
           {{"accepted", projection.moves.accepted}, {"shortened", projection.moves.shortened}, {"refused", projection.moves.refused}}},
          {"stopped_because", projection.stopped_because},
          {"distance_before", distance_json(projection.before)},
          {"distance_after", distance_json(projection.after)}};
}

/// Makes the mesh of one molecule, stage by stage, and notes what each did.
class Generation {
 public:
  Generation(const GenerateRun& run, const ProgressCallback& progress) : run_(run), progress_(progress) {}

  GenerateRunResult go() {
    const Stopwatch total;
    read();
    make_surface();
    if (run_.improve)
      improve_surface();
    else
      choose_components();
    if (run_.project) project();
    if (run_.measures_distance) measure_distance();
    report_progress(progress_, "write", 0);  // an interrupt is still answered here
    timed(times_, "write", [&] { write_mesh(run_.output, mesh_, {run_.digits}); });
    times_.emplace_back("total", total.elapsed());
    return finished();
  }

  /// Of what has been done.
  [[nodiscard]] const StageTimes& times() const { return times_; }

 private:
  void read() {
    MoleculeReadReport read;
    molecule_ = timed(times_, "read", [&] { return read_molecule(run_.molecule, run_.reading, &read); });
    const std::size_t raised = raise_radii(molecule_, run_.min_radius);
    result_.notes = read.notes;
    if (raised > 0)
      result_.notes.push_back(
          fmt::format("{} radii below {} Å were raised to {} Å", raised, std::min(kSmallRadius, run_.min_radius), run_.min_radius));
    result_.report["molecule"] = {{"file", run_.molecule.string()},
                                  {"sha256", is_stream(run_.molecule) ? Json(nullptr) : Json(sha256_of_file(run_.molecule))},
                                  {"atoms", molecule_.atom_count()},
                                  {"raised_radii", raised},
                                  {"notes", result_.notes}};
    result_.report["options"] = run_options_json(run_);
  }

  void make_surface() {
    GaussianSurfaceReport met;
    try {
      mesh_ = timed(times_, "generate", [&] { return gaussian_surface(molecule_, run_.surface, &met, progress_); });
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{}: {}", is_stream(run_.molecule) ? "standard input" : run_.molecule.string(), error.what()));
    }
    result_.report["sampling"] = sampling_json(run_, met);
  }

  void choose_components() {
    const CavityReport removed = timed(times_, "cavities", [&] { return remove_cavities(mesh_, run_.components); });
    result_.report["components"] = {{"found", removed.components},
                                    {"removed_cavities", removed.cavities},
                                    {"removed_islands", removed.islands},
                                    {"removed_outer_components", removed.outer_components}};
  }

  void improve_surface() {
    const Method& method = baselines::all_methods().find(ImproveRun().method);
    const OptionValues defaults(method.options, {});
    const PreparationReport preparation = prepare(mesh_, run_.components);
    const MethodReport outcome = method.run(mesh_, defaults, progress_);
    times_.insert(times_.end(), preparation.seconds.begin(), preparation.seconds.end());
    times_.insert(times_.end(), outcome.seconds.begin(), outcome.seconds.end());
    Json json = {{"method", method.name}, {"options", options_json(method, defaults)}};
    add_outcome(json, preparation, outcome);
    result_.report["improvement"] = json;
  }

  void project() {
    ProjectionOptions options;
    options.keeps_angles = run_.improve;  // a surface as generated has no angles to keep
    const ProjectionReport projection =
        timed(times_, "projection", [&] { return project_onto_level_set(mesh_, field(), run_.surface.isovalue, options, progress_); });
    result_.report["projection"] = projection_json(projection);
    distance_ = projection.after;
  }

  void measure_distance() {
    if (!distance_)
      distance_ = timed(times_, "distance", [&] { return distance_to_level_set(field(), run_.surface.isovalue, mesh_.points); });
    result_.report["distance_to_level_set"] = distance_json(*distance_);
  }

  [[nodiscard]] GaussianField field() const { return GaussianField(molecule_, gaussian_field_options(run_.surface)); }

  GenerateRunResult finished() {
    result_.report["output"] = mesh_json(mesh_, run_.output);
    add_seconds(result_.report, times_);
    add_program(result_.report);
    return std::move(result_);
  }

  const GenerateRun& run_;
  const ProgressCallback& progress_;
  Molecule molecule_;
  TriangleMesh mesh_;
  StageTimes times_;
  std::optional<LevelSetDistance> distance_;  // of the mesh as it is, once it is known
  GenerateRunResult result_;
};

}  // namespace

std::size_t raise_radii(Molecule& molecule, double min_radius) {
  if (!(min_radius >= 0)) throw InvalidOption(fmt::format("min-radius: expected a length that is not negative, got {}", min_radius));
  return min_radius > 0 ? raise_small_radii(molecule, std::min(kSmallRadius, min_radius), min_radius) : 0;
}

CavityPolicy parse_components(std::string_view text) {
  const auto found = std::ranges::find(kComponents, text, &ComponentsName::name);
  if (found == kComponents.end()) throw InvalidOption(fmt::format("components: expected all, outer or main, got {}", text));
  return found->policy;
}

GenerateRunResult run_generation(const GenerateRun& run, const ProgressCallback& progress) {
  std::vector<StageTimes> repeats;
  GenerateRunResult result;
  for (int i = 0; i < run.repeats; ++i) {
    Generation generation(run, progress);
    result = generation.go();
    repeats.push_back(generation.times());
  }
  add_repeats(result.report, repeats);
  add_medians(result.report);
  return result;
}

}  // namespace smopt::experiments
