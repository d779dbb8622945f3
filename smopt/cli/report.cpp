#include "experiments/report.h"

#include <fmt/format.h>

#include <memory>

#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {

void add_report(CLI::App& app, Context& context) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("report", "Write the tables, the figures and the HTML page of a run again, from its records and meshes");
  command->footer("Example: smopt report results/run");
  command->add_option("run", *directory, "the folder that `smopt reproduce` wrote")->required();
  const auto figures = std::make_shared<experiments::FigureOptions>();
  command->add_option("--molecule", figures->figure4_molecule, "what Figure 4 shows (default: the AChE monomer, or the run's first)");
  command->callback([directory, figures, &context] {
    ProgressBar bar(context.is_quiet);
    const experiments::ReportOutcome outcome = experiments::write_report(*directory, bar.callback(), *figures);
    if (outcome.why_no_page) fmt::print(stderr, "report.html is left out: {}\n", *outcome.why_no_page);
    for (const std::string& note : outcome.figure_notes) fmt::print(stderr, "{}\n", note);
    if (!context.is_quiet)
      fmt::print("{} are in {}\n", outcome.why_no_page ? "tables and figures" : "tables, figures and report.html", *directory);
  });
}

}  // namespace smopt::cli
