#include <fmt/format.h>

#include <memory>

#include "experiments/runner.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {

void add_step(CLI::App& app, Context& context) {
  const auto planned = std::make_shared<experiments::PlannedStep>();
  CLI::App* command = app.add_subcommand("step", "Do one step of a plan that `reproduce --plan` made (for workflow programs)");
  command->footer(
      "Runs the step's command in a process of its own, with its limits on time and memory, and writes what became of it beside its files; "
      "a\n"
      "step that fails is an answer, not an error. Steps are to be done after those that their `after` in plan.json names.\n"
      "With --threads a step that could use all cores uses that many.\n"
      "\n"
      "Example:\n"
      "  smopt step results/run/plan.json fas2/smopt.improve");
  command->add_option("plan", planned->plan_file, "the run's plan.json; its folder is the run's")->required();
  command->add_option("id", planned->id, "the step's")->required();
  command->callback([planned, &context] {
    ProgressBar bar(context.is_quiet);
    planned->threads = context.threads;
    const std::string status = experiments::run_planned_step(*planned, bar.callback());
    if (!context.is_quiet) fmt::print("{}: {}\n", planned->id, status);
  });
}

}  // namespace smopt::cli
