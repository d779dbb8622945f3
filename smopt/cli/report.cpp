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
  command->callback([directory, &context] {
    ProgressBar bar(context.is_quiet);
    const experiments::ReportOutcome outcome = experiments::write_report(*directory, bar.callback());
    if (outcome.why_no_page) fmt::print(stderr, "report.html is left out: {}\n", *outcome.why_no_page);
    if (!context.is_quiet)
      fmt::print("{} are in {}\n", outcome.why_no_page ? "tables and figures" : "tables, figures and report.html", *directory);
  });
}

}  // namespace smopt::cli
