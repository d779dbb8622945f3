#include "experiments/report.h"

#include <fmt/format.h>

#include <memory>

#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {

void add_report(CLI::App& app, Context& context) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "Write the tables and figures of a run again, from its records");
  command->footer("Example: smopt report results/run");
  command->add_option("run", *directory, "the folder that `smopt reproduce` wrote")->required();
  command->callback([directory, &context] {
    ProgressBar bar(context.is_quiet);
    experiments::write_report(*directory, bar.callback());
    if (!context.is_quiet) fmt::print("tables and figures are in {}\n", *directory);
  });
}

}  // namespace smopt::cli
