#include <fmt/format.h>

#include <memory>

#include "metrics/tetgen/tet_mesh_io.h"
#include "metrics/tetgen/tetrahedralize.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {
namespace {

struct Arguments {
  std::string mesh;
  std::string output;
  std::string report;
  metrics::TetrahedralizeOptions options;
  bool is_json = false;
};

void print(const metrics::Tetrahedralization& result) {
  if (result.success) {
    fmt::print("success: {} tetrahedra, {:.2f} s, {:.0f} MB\n", result.tetrahedra, result.seconds, result.peak_memory_mb);
  } else {
    fmt::print("failed: {}\n", result.reason);
  }
}

void run(const Arguments& arguments, Context& context) {
  if (!arguments.output.empty() && !metrics::is_tet_mesh_format(arguments.output))
    throw InvalidOption(fmt::format("{}: a volume mesh is written as .vtu, .msh, .node or .ele", arguments.output));
  if (!arguments.output.empty()) require_writable_place(arguments.output);
  if (!arguments.report.empty()) require_writable_place(arguments.report);
  metrics::TetrahedralizeOptions options = arguments.options;
  ProgressBar bar(context.is_quiet);
  options.progress = bar.callback();
  const TriangleMesh mesh = read_mesh(arguments.mesh);
  const CancellableSection section;
  const metrics::Tetrahedralization result = metrics::tetrahedralize(mesh, options);
  if (result.success && !arguments.output.empty()) metrics::write_tet_mesh(arguments.output, result.mesh);
  const std::string json = metrics::to_json(result).dump(2) + "\n";
  if (!arguments.report.empty()) write_file(arguments.report, json);
  if (arguments.is_json)
    fmt::print("{}", json);
  else
    print(result);
  if (!result.success) context.exit_code = ExitCode::answer_is_no;
}

}  // namespace

void add_tetrahedralize(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("tetrahedralize", "Fill a surface with tetrahedra by TetGen, and check the result");
  command->footer(
      "TetGen runs in a process of its own. Success means that it returned tetrahedra whose volumes sum to the enclosed volume and whose\n"
      "boundary is the surface; otherwise the reason is named and the exit code is 1.\n"
      "\n"
      "Examples:\n"
      "  smopt tetrahedralize improved.off -o volume.vtu\n"
      "  smopt tetrahedralize improved.off --switches pY --json");
  command->add_option("mesh", arguments->mesh, "the surface (" + mesh_format_names() + ", each also .gz; - for OFF)")->required();
  command->add_option("-o,--output", arguments->output, "the volume mesh to write (.vtu, .msh, .node, .ele)");
  command
      ->add_option("--switches", arguments->options.switches,
                   "TetGen's; p: keep the surface, pY: keep its triangles too, pq1.4: with quality")
      ->capture_default_str();
  command->add_option("--time-limit", arguments->options.time_limit_seconds, "seconds after which TetGen is ended")->capture_default_str();
  command->add_option("--max-memory", arguments->options.memory_limit_mb, "address space of TetGen, MB; 0: no limit")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--report", arguments->report, "write the result as JSON to this file");
  command->add_flag("--json", arguments->is_json, "as JSON");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
