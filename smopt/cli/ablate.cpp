#include "experiments/ablation/ablate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"

namespace smopt::cli {
namespace {

constexpr int kDefaultRepeats = 3;

/// "Guard: which moves are refused", a line each.
std::string part_names() {
  std::string text;
  for (const experiments::Factor& factor : experiments::ablation_plan(false).factors)
    text += fmt::format("  {}: {}\n", factor.title, factor.about);
  return text;
}

void run(experiments::AblateOptions& options, Context& context) {
  if (options.run.jobs == 0) options.run.jobs = context.threads;
  ProgressBar bar(context.is_quiet);
  experiments::RunObserver observer;
  observer.progress = bar.callback();
  if (!context.is_quiet) observer.line = [&bar](std::string_view line) { bar.print_line(line); };
  const experiments::RunSummary summary = experiments::ablate(options, observer);
  if (context.is_quiet) return;
  fmt::print("{} cases, {} failed, {:.0f} s; what each part contributes is in {}\n", summary.cases.size(),
             summary.count(experiments::CaseStatus::failed), summary.seconds, (options.directory / "README.md").string());
}

}  // namespace

void add_ablate(CLI::App& app, Context& context) {
  const auto options = std::make_shared<experiments::AblateOptions>();
  options->run.repeats = kDefaultRepeats;
  CLI::App* command =
      app.add_subcommand("ablate", "What each part of SMOPT contributes: the method with parts of it set otherwise or left out");
  command->footer("Parts:\n" + part_names() +
                  "\n"
                  "one-at-a-time: all defaults, and each part alone at each of its other settings\n"
                  "factorial: every combination of some settings; main effects and interactions of two parts\n"
                  "thresholds: a grid of the two thresholds of screening\n"
                  "A case that fails is a row with its reason.\n"
                  "\n"
                  "Examples:\n"
                  "  smopt ablate --quick -o results/ablation-quick\n"
                  "  smopt ablate --design thresholds --molecules ache-monomer -o results/thresholds\n"
                  "  smopt ablate --resume");
  command->add_option("-o,--output", options->directory, "folder for records, tables, figures and README.md")->capture_default_str();
  command
      ->add_option("--molecules", options->molecules,
                   fmt::format("names as in `smopt reproduce --help`, separated by commas [{}]",
                               fmt::join(experiments::ablation_plan(false).molecules, ",")))
      ->delimiter(',');
  command->add_option("--data", options->data, "a folder of molecules and ready meshes that --molecules may name, as in `smopt reproduce`")
      ->envname("SMOPT_DATA");
  command->add_option("--design", options->design, "which cases")
      ->check(CLI::IsMember({"one-at-a-time", "factorial", "thresholds", "all"}))
      ->capture_default_str();
  command->add_option("--repeats", options->run.repeats, "how often everything that is timed is run")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--quick", options->is_quick,
                    fmt::format("fewer settings, one repeat, {} only", fmt::join(experiments::ablation_plan(true).molecules, ",")));
  command->add_flag("--resume", options->run.resumes,
                    "do not do again what was done in the folder by this program with the same files and options");
  command->add_flag("--retry", options->run.retries, "with --resume: do again what failed");
  command->add_option("--jobs", options->run.jobs, "how many cores the steps share [all]")->check(CLI::Range(1, 1024));
  command->add_option("--step-time", options->run.step_seconds, "seconds after which any step is ended; its case is a row that says so")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace smopt::cli
