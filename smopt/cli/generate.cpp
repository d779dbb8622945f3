#include <fmt/format.h>

#include <memory>

#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/molecule.h"
#include "smopt/surface/gaussian_surface.h"
#include "smopt/timing.h"

namespace smopt::cli {
namespace {

struct Arguments {
  std::string molecule;
  std::string output;
  GaussianSurfaceOptions surface;
  int digits = 0;
};

void run(const Arguments& arguments, const Context& context) {
  const Stopwatch stopwatch;
  ProgressBar bar(context.is_quiet);
  require_writable_mesh(arguments.output);
  require_writable_place(arguments.output);
  GaussianSurfaceReport report;
  const TriangleMesh mesh = gaussian_surface(read_molecule(arguments.molecule), arguments.surface, &report, bar.callback());
  write_mesh(arguments.output, mesh, {arguments.digits});
  if (!context.is_quiet) {
    fmt::print(stderr, "{}: {} atoms, {} vertices, {} triangles, {:.2f} s\n", arguments.output, report.atoms, mesh.vertex_count(),
               mesh.triangle_count(), stopwatch.elapsed().wall);
  }
}

}  // namespace

void add_generate(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("generate", "Make the Gaussian surface mesh of a molecule");
  command->footer(
      "The surface is φ(x) = c with φ(x) = Σ exp(-d(|x - x_i|² - r_i²)), a sum over the atoms. A larger decay d shows more detail, a "
      "larger\n"
      "isovalue c encloses less. Vertices stay where the surface crosses the grid: the mesh is closed and free of intersections, and as\n"
      "irregular as that makes it; `smopt improve` is the next step.\n"
      "\n"
      "Example: smopt generate /usr/share/apbs/examples/misc/mache.pqr -o ache.off");
  command->add_option("molecule", arguments->molecule, "the molecule (.pqr, .pqr.gz)")->required();
  command->add_option("-o,--output", arguments->output, "the mesh to write (" + mesh_format_names() + ", each also .gz; - for OFF)")
      ->required();
  command->add_option("--decay", arguments->surface.decay, "d, 1/Å²")->capture_default_str();
  command->add_option("--isovalue", arguments->surface.isovalue, "c")->capture_default_str();
  command->add_option("--spacing", arguments->surface.spacing, "edge of the grid's cubes, Å")->capture_default_str();
  command->add_option("--digits", arguments->digits, "significant digits to write (default: enough to read the same doubles back)")
      ->check(CLI::Range(1, 17));
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
