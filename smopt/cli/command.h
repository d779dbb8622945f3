#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "experiments/report.h"

namespace smopt::cli {

/// What a command came to; the number is the program's exit code.
enum class ExitCode {
  done = 0,
  answer_is_no = 1,  ///< done, and the answer is no: TetGen failed, a solve did not succeed, new pairs were found
  wrong_usage = 2,
  bad_input = 3,  ///< file, line or element named; nothing written
  internal_error = 4,
  interrupted = 130
};

/// Options that every command takes, and what the command that ran came to.
struct Context {
  int threads = 0;  ///< 0: all cores
  bool is_quiet = false;
  int argc = 0;
  char** argv = nullptr;
  ExitCode exit_code = ExitCode::done;
};

/// \throws InvalidOption unless the name's ending is that of a mesh format that can be written: told before any work is done.
void require_writable_mesh(const std::string& file);

/// \throws InvalidInput when no file of that name can be written where it should be: told before any work is done.
void require_writable_place(const std::string& file);

/// Tells, on standard error, what a report lacks and why.
void print_left_out(const experiments::ReportOutcome& report);

/// Each adds its subcommand to the program.
void add_generate(CLI::App& app, Context& context);
void add_improve(CLI::App& app, Context& context);
void add_methods(CLI::App& app, Context& context);
void add_measure(CLI::App& app, Context& context);
void add_tetrahedralize(CLI::App& app, Context& context);
void add_solvate(CLI::App& app, Context& context);
void add_convert(CLI::App& app, Context& context);
void add_ablate(CLI::App& app, Context& context);
void add_reproduce(CLI::App& app, Context& context);
void add_step(CLI::App& app, Context& context);
void add_report(CLI::App& app, Context& context);
void add_regress(CLI::App& app, Context& context);

}  // namespace smopt::cli
