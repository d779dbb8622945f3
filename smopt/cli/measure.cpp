#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/generate_run.h"
#include "experiments/level_set_run.h"
#include "metrics/measure.h"
#include "metrics/measurement_json.h"
#include "metrics/table.h"
#include "smopt/cli/command.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> meshes;
  std::string reference;
  std::string molecule;
  GaussianSurfaceOptions surface;
  std::string report;
  bool is_json = false;
};

/// With the radii that `generate` would give it.
experiments::LevelSet level_set_of(const Arguments& arguments) {
  Molecule molecule = read_molecule(arguments.molecule);
  experiments::raise_radii(molecule, experiments::GenerateRun().min_radius);
  return {molecule, arguments.surface};
}

/// Each mesh by its name, and as JSON with everything that was asked for.
struct Measured {
  std::vector<metrics::NamedMeasurement> measurements;
  std::vector<Json> objects;
};

Measured measure_all(const Arguments& arguments) {
  TriangleMesh reference;
  metrics::MeasureOptions options;
  if (!arguments.reference.empty()) {
    reference = read_mesh(arguments.reference);
    options.reference = &reference;
  }
  std::optional<experiments::LevelSet> level_set;
  if (!arguments.molecule.empty()) level_set = level_set_of(arguments);
  Measured measured;
  for (const std::string& file : arguments.meshes) {
    const TriangleMesh mesh = read_mesh(file);
    measured.measurements.push_back({file, metrics::measure(mesh, options)});
    measured.objects.push_back(metrics::to_json(measured.measurements.back().measurement));
    if (level_set) measured.objects.back()["level_set_distance"] = experiments::to_json(level_set->distance(mesh));
  }
  return measured;
}

/// The rows below the table of metrics, which does not know molecules.
void print_level_set_distances(const Arguments& arguments, const std::vector<Json>& objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Json& distance = objects[i].at("level_set_distance");
    if (distance.is_null())
      fmt::print("{}: no distance to the level set\n", arguments.meshes[i]);
    else
      fmt::print("{}: {:.4f} Å from the level set in the mean, {:.4f} Å at most\n", arguments.meshes[i], distance.at("mean").get<double>(),
                 distance.at("largest").get<double>());
  }
}

void run(const Arguments& arguments) {
  if (!arguments.report.empty()) require_writable_place(arguments.report);
  const Measured measured = measure_all(arguments);
  const Json all = measured.objects.size() == 1 ? measured.objects.front() : Json(measured.objects);
  const std::string json = all.dump(2) + "\n";
  if (!arguments.report.empty()) write_file(arguments.report, json);
  if (arguments.is_json) {
    fmt::print("{}", json);
    return;
  }
  fmt::print("{}", metrics::format_table(measured.measurements));
  if (!arguments.molecule.empty()) print_level_set_distances(arguments, measured.objects);
}

}  // namespace

void add_measure(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("measure", "Measure meshes: validity, intersecting pairs, size, shape of the triangles");
  command->footer(
      "Any mesh that can be read is measured, a broken one too; where a number does not exist the notes say why.\n"
      "\n"
      "Examples:\n"
      "  smopt measure surface.off improved.off\n"
      "  smopt measure improved.off --reference surface.off --json\n"
      "  smopt measure improved.off --molecule molecule.pqr          how far it is from the molecule's Gaussian surface");
  command->add_option("meshes", arguments->meshes, "meshes (" + mesh_format_names() + ", each also .gz; - for OFF)")->required();
  command->add_option("--reference", arguments->reference, "measure the distance to this surface too");
  CLI::Option* molecule = command->add_option(
      "--molecule", arguments->molecule, "measure the distance to the level set of this molecule too (" + molecule_format_names() + ")");
  command->add_option("--decay", arguments->surface.decay, "of that level set, 1/Å², as `generate` has it")
      ->needs(molecule)
      ->capture_default_str();
  command->add_option("--isovalue", arguments->surface.isovalue, "of that level set, as `generate` has it")
      ->needs(molecule)
      ->capture_default_str();
  command->add_option("--report", arguments->report, "write what --json prints to this file");
  command->add_flag("--json", arguments->is_json, "one object for one mesh, an array for several");
  static_cast<void>(context);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace smopt::cli
