#include <fmt/format.h>

#include <oneapi/tbb/global_control.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <optional>
#include <system_error>

#include "smopt/cli/command.h"
#include "smopt/cli/interrupt.h"
#include "smopt/error.h"
#include "smopt/version.h"

namespace smopt::cli {
namespace {

constexpr const char* kDescription =
    "SMOPT makes triangle meshes of molecular surfaces fit for simulation without ever letting two triangles intersect.\n"
    "\n"
    "  smopt generate molecule.pqr -o surface.off      the molecule's Gaussian surface\n"
    "  smopt improve surface.off -o improved.off       the same surface, fit for simulation\n"
    "  smopt measure surface.off improved.off          what has become better\n"
    "  smopt tetrahedralize improved.off -o mesh.vtu   a volume mesh by TetGen\n"
    "  smopt solvate improved.off molecule.pqr         the molecule's solvation energy";

int report_error(const char* what, ExitCode code) {
  fmt::print(stderr, "smopt: {}\n", what);
  return static_cast<int>(code);
}

void add_commands(CLI::App& app, Context& context) {
  add_generate(app, context);
  add_improve(app, context);
  add_methods(app, context);
  add_measure(app, context);
  add_tetrahedralize(app, context);
  add_solvate(app, context);
  add_convert(app, context);
  add_ablate(app, context);
  add_reproduce(app, context);
  add_step(app, context);
  add_report(app, context);
  add_regress(app, context);
}

/// Prints help or version where they were asked for, otherwise what is wrong with the command line; the exit code.
int answer(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining();
  const bool has_no_command = app.get_subcommands().empty();
  if (app.exit(error) == 0) return 0;
  if (has_no_command && !unknown.empty()) fmt::print(stderr, "'{}' is neither a command nor an option\n", unknown.front());
  return static_cast<int>(ExitCode::wrong_usage);
}

/// What was printed must have arrived: a full disk is not a success.
void flush_standard_output() {
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "standard output");
}

/// Parses the command line and runs the command, which is a callback of its subcommand.
int run(int argc, char** argv) {
  Context context;
  context.argc = argc;
  context.argv = argv;
  CLI::App app(kDescription, "smopt");
  app.set_version_flag("--version", fmt::format("smopt {}", version()));
  app.require_subcommand(1);
  app.fallthrough();
  std::optional<tbb::global_control> limit;
  app.add_option_function<int>(
         "--threads",
         [&](const int& threads) {
           context.threads = threads;
           limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
         },
         "threads to use (default: all cores); the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->trigger_on_parse();
  app.add_flag("--quiet", context.is_quiet, "no progress bar, no summary");
  add_commands(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer(app, error);
  }
  flush_standard_output();
  return static_cast<int>(context.exit_code);
}

}  // namespace
}  // namespace smopt::cli

int main(int argc, char** argv) {
  using namespace smopt::cli;
  install_interrupt_handler();
  try {
    return run(argc, argv);
  } catch (const smopt::InvalidOption& error) {
    return report_error(error.what(), ExitCode::wrong_usage);
  } catch (const smopt::InvalidInput& error) {
    return report_error(error.what(), ExitCode::bad_input);
  } catch (const smopt::NotInstalled& error) {
    return report_error(fmt::format("{}{}", smopt::kNotInstalledPrefix, error.what()).c_str(), ExitCode::answer_is_no);
  } catch (const smopt::MethodFailed& error) {
    return report_error(error.what(), ExitCode::answer_is_no);
  } catch (const smopt::Cancelled&) {
    return report_error("interrupted", ExitCode::interrupted);
  } catch (const std::system_error& error) {
    return report_error(error.what(), ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    return report_error("out of memory", ExitCode::internal_error);
  } catch (const std::exception& error) {
    return report_error(fmt::format("internal error: {}", error.what()).c_str(), ExitCode::internal_error);
  }
}
