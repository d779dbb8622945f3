#include <memory>

#include "smopt/cli/command.h"
#include "smopt/cli/interrupt.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {
namespace {

struct Arguments {
  std::string input, output;
  int digits = 0;
};

}  // namespace

void add_convert(CLI::App& app, Context& /*context*/) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("convert", "Convert a mesh from one format to another");
  command->footer("Formats: " + mesh_format_names() +
                  "; each also with .gz. STL is written in single precision.\n\nExample: smopt convert surface.off surface.vtp");
  command->add_option("input", arguments->input, "the mesh to read (- for OFF)")->required();
  command->add_option("output", arguments->output, "the mesh to write (- for OFF)")->required();
  command->add_option("--digits", arguments->digits, "significant digits to write (default: enough to read the same doubles back)")
      ->check(CLI::Range(1, 17));
  command->callback([arguments] {
    require_writable_mesh(arguments->output);
    const TriangleMesh mesh = read_mesh(arguments->input);
    const CancellableSection section;
    write_mesh(arguments->output, mesh, {arguments->digits});
  });
}

}  // namespace smopt::cli
