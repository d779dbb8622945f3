#include "experiments/report.h"

#include <fmt/format.h>

#include <memory>

#include "experiments/claims/claims.h"
#include "experiments/record_set.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {
namespace {

struct Arguments {
  std::string directory;
  std::string claims;
  experiments::FigureOptions figures;
};

void run(const Arguments& arguments, const Context& context) {
  if (!arguments.claims.empty()) require_writable_place(arguments.claims);
  ProgressBar bar(context.is_quiet);
  const experiments::ReportOutcome outcome = experiments::write_report(arguments.directory, bar.callback(), arguments.figures);
  if (!arguments.claims.empty()) experiments::write_claims(experiments::RecordSet::load(arguments.directory), arguments.claims);
  print_left_out(outcome);
  if (!context.is_quiet)
    fmt::print("{} are in {}\n", outcome.why_no_page ? "tables and figures" : "tables, figures and report.html", arguments.directory);
}

}  // namespace

void print_left_out(const experiments::ReportOutcome& outcome) {
  if (outcome.why_no_page) fmt::print(stderr, "report.html is left out: {}\n", *outcome.why_no_page);
  for (const std::string& note : outcome.figure_notes) fmt::print(stderr, "{}\n", note);
}

void add_report(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("report", "Write the tables, the figures and the HTML page of a run again, from its records and meshes");
  command->footer(
      "Examples:\n"
      "  smopt report results/run\n"
      "  smopt report results/reference --claims results/README.md");
  command->add_option("run", arguments->directory, "the folder that `smopt reproduce` wrote")->required();
  command->add_option("--molecule", arguments->figures.figure4_molecule,
                      "what Figure 4 shows (default: the AChE monomer, or the run's first)");
  command->add_option("--claims", arguments->claims, "write what the records say of each of the paper's claims to this file (Markdown)");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
