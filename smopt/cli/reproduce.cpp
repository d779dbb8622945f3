#include "experiments/reproduce.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "experiments/datasets.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/io/file.h"

namespace smopt::cli {
namespace {

constexpr int kDefaultRepeats = 3;

std::string names_of(const std::vector<experiments::Dataset>& datasets) {
  std::vector<std::string> names;
  for (const experiments::Dataset& dataset : datasets) names.push_back(dataset.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string dataset_names() {
  return names_of(experiments::all_datasets());
}

std::string default_names() {
  return names_of(experiments::datasets_of(experiments::all_datasets(), experiments::kDefaultSuite));
}

/// "20 cases, 1 failed, 2 not installed, 31 s".
std::string counts_of(const experiments::RunSummary& summary) {
  using experiments::CaseStatus;
  const std::size_t absent = summary.count(CaseStatus::not_installed);
  const std::string reused = summary.steps_reused > 0 ? fmt::format("{} steps were done before, ", summary.steps_reused) : "";
  return fmt::format("{} cases, {} failed, {}{}{:.0f} s", summary.cases.size(), summary.count(CaseStatus::failed),
                     absent > 0 ? fmt::format("{} not installed, ", absent) : "", reused, summary.seconds);
}

std::string case_names() {
  std::vector<std::string> names = {std::string(experiments::kInitial)};
  for (const experiments::MethodCase& method_case : experiments::all_method_cases()) names.push_back(method_case.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void tell_left_out(const experiments::ReproduceOptions& options, const Context& context) {
  const std::vector<std::string> names = experiments::left_out_of_folder(options);
  if (names.empty() || context.is_quiet) return;
  fmt::print(stderr, "note: not run of {}, as the suites or names asked for leave it out: {}\n", options.data.string(),
             fmt::join(names, ", "));
}

void run(experiments::ReproduceOptions& options, Context& context) {
  if (options.run.jobs == 0) options.run.jobs = context.threads;
  tell_left_out(options, context);
  ProgressBar bar(context.is_quiet);
  experiments::RunObserver observer;
  observer.progress = bar.callback();
  if (!context.is_quiet) observer.line = [&bar](std::string_view line) { bar.print_line(line); };
  const experiments::ReproduceSummary summary = experiments::reproduce(options, observer);
  if (options.is_plan_only) {
    fmt::print("{}\n", (options.directory / "plan.json").string());
    return;
  }
  print_left_out(summary.report);
  if (context.is_quiet) return;
  fmt::print("\n{}\n{}; tables and figures are in {}\n", read_file(options.directory / "tables" / "methods.md"), counts_of(summary),
             options.directory.string());
  if (const std::size_t earlier = summary.earlier_cases(); earlier > 0)
    fmt::print("they show {} cases of earlier runs in this folder, too (records/)\n", earlier);
}

void add_choices(CLI::App& command, experiments::ReproduceOptions& options) {
  command.add_option("--molecules", options.molecules, "only these, separated by commas")->delimiter(',');
  command.add_flag("--quick", options.is_quick, "small molecules only, one repeat");
  command.add_flag("--full", options.is_full, "the paper's six rows: hours; needs --data");
  command.add_option("--suite", options.suites, "the molecules of these suites, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"default", "quick", "paper", "extended"}));
  command
      .add_option("--data", options.data,
                  "a folder of molecules (NAME.pqr, .pdb, .cif, …) and ready meshes (NAME.off, …, in the place of a generated surface), "
                  "each also .gz")
      ->envname("SMOPT_DATA");
  command
      .add_option("--methods", options.methods, "names from the list above or from `smopt methods`, separated by commas, or all by itself")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--override", options.overrides, "METHOD:OPTION=VALUE, separated by commas: run a method with another option")
      ->delimiter(',');
}

void add_run_options(CLI::App& command, experiments::ReproduceOptions& options) {
  experiments::RunOptions& run = options.run;
  command.add_flag("--resume", run.resumes, "do not do again what was done in the folder by this program with the same files and options");
  command.add_flag("--retry", run.retries, "with --resume: do again what failed");
  command.add_flag("--plan", options.is_plan_only, "write the steps to plan.json, for a workflow program, and run nothing");
  command.add_option("--jobs", run.jobs, "how many cores the steps share [all]")->check(CLI::Range(1, 1024));
  command.add_option("--memory", run.memory_bytes, "that steps side by side may take, such as 8GB [two thirds of the machine's]")
      ->transform(CLI::AsSizeValue(false));
  command.add_option("--step-time", run.step_seconds, "seconds after which any step is ended; its case is a row that says so")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--step-memory", run.step_memory_mb, "MB of address space that a step may take")->capture_default_str();
  command.add_option("--repeats", run.repeats, "how often everything that is timed is run")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_flag("--keep-meshes", run.keeps_meshes, "write each case's mesh as OFF too");
  command
      .add_option("--solvation-memory", run.solvation.max_memory_bytes,
                  "memory that computing one solvation energy may take, such as 4GB; a case that needs more is a row that says so [12GB]")
      ->transform(CLI::AsSizeValue(false));
}

}  // namespace

void add_reproduce(CLI::App& app, Context& context) {
  const auto options = std::make_shared<experiments::ReproduceOptions>();
  options->run.repeats = kDefaultRepeats;
  CLI::App* command = app.add_subcommand("reproduce", "Run the experiments: Tables 1 to 3 and Figures 4 to 7 of the paper");
  command->footer(
      "Each molecule is meshed, improved by each method, measured and given to TetGen; every step is a process of its own, and a case that "
      "fails\n"
      "is a row with its reason. What is timed runs alone. A run that was interrupted goes on with --resume.\n"
      "Molecules (by default " +
      default_names() + "):\n  " + dataset_names() +
      "\n"
      "Methods: " +
      case_names() +
      "\n"
      "\n"
      "Examples:\n"
      "  smopt reproduce\n"
      "  smopt reproduce --molecules ache-monomer --methods initial,smopt,laplacian -o results/ache\n"
      "  smopt reproduce --full --data molecules --resume\n"
      "  smopt reproduce --data meshes-of-mine --methods all -o results/mine");
  command->add_option("-o,--output", options->directory, "folder for records, tables and figures")->capture_default_str();
  add_choices(*command, *options);
  add_run_options(*command, *options);
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace smopt::cli
