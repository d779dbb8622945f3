#include <fmt/format.h>

#include <memory>

#include "experiments/generate_run.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/radius_set.h"

namespace smopt::cli {
namespace {

struct Arguments {
  experiments::GenerateRun run;
  std::string components;
  std::string radii;
  std::string report;
  bool is_json = false;
};

/// What would be found out only after the work.
void require_outputs(const Arguments& arguments) {
  const std::string output = arguments.run.output.string();
  if (output == "-" && (arguments.is_json || arguments.report == "-"))
    throw InvalidOption("the mesh and the report cannot both go to standard output");
  require_writable_mesh(output);
  require_writable_place(output);
  if (!arguments.report.empty()) require_writable_place(arguments.report);
}

/// Cavities collapse when they are smoothed, so that `--improve` deletes them unless told otherwise.
std::string default_components(bool improves) {
  return improves ? "outer" : "all";
}

void take_choices(Arguments& arguments) {
  experiments::GenerateRun& run = arguments.run;
  run.components = experiments::parse_components(arguments.components.empty() ? default_components(run.improve) : arguments.components);
  if (!arguments.radii.empty()) run.reading.radius_set = radius_set_by_name(arguments.radii);
  run.measures_distance = arguments.is_json || !arguments.report.empty();
}

void print_summary(const experiments::GenerateRunResult& result) {
  const nlohmann::ordered_json& report = result.report;
  for (const std::string& note : result.notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print(stderr, "{}: {} atoms, {} vertices, {} triangles", report["output"]["file"].get<std::string>(),
             report["molecule"]["atoms"].get<long>(), report["output"]["vertices"].get<long>(), report["output"]["triangles"].get<long>());
  if (report.contains("projection")) fmt::print(stderr, ", {} vertices on the level set", report["projection"]["arrived"].get<long>());
  fmt::print(stderr, ", {:.2f} s\n", report["seconds"]["total"].get<double>());
}

void run(Arguments& arguments, const Context& context) {
  require_outputs(arguments);
  take_choices(arguments);
  ProgressBar bar(context.is_quiet);
  const experiments::GenerateRunResult result = experiments::run_generation(arguments.run, bar.callback());
  const std::string report = result.report.dump(2) + "\n";
  if (!arguments.report.empty()) write_file(arguments.report, report);
  if (arguments.is_json) fmt::print("{}", report);
  if (!context.is_quiet) print_summary(result);
}

void add_surface_options(CLI::App& command, Arguments& arguments) {
  GaussianSurfaceOptions& surface = arguments.run.surface;
  command.add_option("--decay", surface.decay, "d, 1/Å²: a larger one shows more detail")->capture_default_str();
  command.add_option("--isovalue", surface.isovalue, "c: a larger one encloses less")->capture_default_str();
  CLI::Option* spacing =
      command.add_option("--spacing", surface.spacing, "edge of the cubes of a uniform grid, Å; the simple choice")->capture_default_str();
  command
      .add_option("--error", surface.error,
                  "instead: divide cubes until their surface is within this distance of the true one, Å (try 0.5)")
      ->excludes(spacing);
  command
      .add_option("--max-memory", surface.max_memory_bytes,
                  "refuse, before the work, what would need more memory than this (such as 500MB or 4GB; default: what the machine has)")
      ->transform(CLI::AsSizeValue(false));
}

void add_molecule_options(CLI::App& command, Arguments& arguments) {
  command.add_option("--min-radius", arguments.run.min_radius, "what radii below 0.5 Å become, Å; 0: they stay (0.6 as TMSmesh has it)")
      ->capture_default_str();
  command.add_option("--radii", arguments.radii, "radii by element for formats without (" + radius_set_names() + ") [bondi]");
  command.add_flag("--keep-waters", arguments.run.reading.keep_waters, "keep the water of PDB and mmCIF files");
}

}  // namespace

void add_generate(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("generate", "Make the Gaussian surface mesh of a molecule");
  command->footer(
      "The surface is φ(x) = c with φ(x) = Σ exp(-d(|x - x_i|² - r_i²)), a sum over the atoms. A larger decay d shows more detail (the "
      "paper's\n"
      "sentence has it the wrong way round), a larger isovalue c encloses less. The mesh is closed, manifold and free of intersections, "
      "and as\n"
      "irregular as the cubes make it; --improve gives the simulation-ready mesh directly, --project puts its vertices onto the surface.\n"
      "\n"
      "Examples:\n"
      "  smopt generate /usr/share/apbs/examples/misc/mache.pqr -o ache.off\n"
      "  smopt generate molecule.pdb -o ready.off --improve --project --report ready.json\n"
      "  smopt generate molecule.cif.gz -o fine.ply --error 0.2 --components outer");
  command->add_option("molecule", arguments->run.molecule, "the molecule (" + molecule_format_names() + ", each also .gz; - for PQR)")
      ->required();
  command->add_option("-o,--output", arguments->run.output, "the mesh to write (" + mesh_format_names() + ", each also .gz; - for OFF)")
      ->required();
  add_surface_options(*command, *arguments);
  add_molecule_options(*command, *arguments);
  command->add_option("--components", arguments->components,
                      "all, outer (without cavities) or main (the largest) [all; with --improve: outer]");
  command->add_flag("--improve", arguments->run.improve, "improve the mesh as `smopt improve` does with its defaults");
  command->add_flag("--project", arguments->run.project, "move the vertices onto φ = c as far as no two triangles come to intersect");
  command->add_option("--report", arguments->report, "write what was done, and the vertices' distance to φ = c, as JSON to this file");
  command
      ->add_option("--repeats", arguments->run.repeats, "how often it is done, for the times in the report: all of them and their medians")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--digits", arguments->run.digits, "significant digits to write (default: enough to read the same doubles back)")
      ->check(CLI::Range(1, 17));
  command->add_flag("--json", arguments->is_json, "print the report");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
