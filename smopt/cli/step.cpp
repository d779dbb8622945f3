#include <fmt/format.h>

#include <memory>

#include "experiments/runner.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {

void add_step(CLI::App& app, Context& context) {
  struct Arguments {
    std::string plan, id;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("step", "Do one step of a plan that `reproduce --plan` made (for workflow programs)");
  command->footer(
      "Runs the step's command in a process of its own, with its limits on time and memory, and writes what became of it beside its files; "
      "a\n"
      "step that fails is an answer, not an error. Steps are to be done after those that their `after` in plan.json names.\n"
      "\n"
      "Example:\n"
      "  smopt step results/run/plan.json fas2/smopt.improve");
  command->add_option("plan", arguments->plan, "the run's plan.json; its folder is the run's")->required();
  command->add_option("id", arguments->id, "the step's")->required();
  command->callback([arguments, &context] {
    ProgressBar bar(context.is_quiet);
    const std::string status = experiments::run_planned_step(arguments->plan, arguments->id, {}, bar.callback());
    if (!context.is_quiet) fmt::print("{}: {}\n", arguments->id, status);
  });
}

}  // namespace smopt::cli
