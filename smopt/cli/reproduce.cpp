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

std::string dataset_names() {
  std::vector<std::string> names;
  for (const experiments::Dataset& dataset : experiments::all_datasets()) names.push_back(dataset.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "20 cases, 1 failed, 2 not installed, 31 s".
std::string counts_of(const experiments::RunSummary& summary) {
  using experiments::CaseStatus;
  const std::size_t absent = summary.count(CaseStatus::not_installed);
  return fmt::format("{} cases, {} failed, {}{:.0f} s", summary.cases.size(), summary.count(CaseStatus::failed),
                     absent > 0 ? fmt::format("{} not installed, ", absent) : "", summary.seconds);
}

std::string case_names() {
  std::vector<std::string> names = {std::string(experiments::kInitial)};
  for (const experiments::MethodCase& method_case : experiments::all_method_cases()) names.push_back(method_case.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void run(const experiments::ReproduceOptions& options, Context& context) {
  ProgressBar bar(context.is_quiet);
  experiments::RunObserver observer;
  observer.progress = bar.callback();
  if (!context.is_quiet) observer.line = [&bar](std::string_view line) { bar.print_line(line); };
  const experiments::RunSummary summary = experiments::reproduce(options, observer);
  if (context.is_quiet) return;
  fmt::print("\n{}\n{}; tables and figures are in {}\n", read_file(options.directory / "tables" / "methods.md"), counts_of(summary),
             options.directory.string());
}

}  // namespace

void add_reproduce(CLI::App& app, Context& context) {
  const auto options = std::make_shared<experiments::ReproduceOptions>();
  CLI::App* command = app.add_subcommand("reproduce", "Run the experiments: Tables 1 to 3 and Figures 5 to 7 of the paper");
  command->footer(
      "Each molecule is meshed, improved by each method, measured and given to TetGen; a case that fails is a row with its reason.\n"
      "Molecules: " +
      dataset_names() +
      "\n"
      "Methods: " +
      case_names() +
      "\n"
      "\n"
      "Examples:\n"
      "  smopt reproduce\n"
      "  smopt reproduce --molecules ache-monomer --methods initial,smopt,laplacian -o results/ache\n"
      "  smopt reproduce --molecules ache-monomer --methods all -o results/ache");
  command->add_option("-o,--output", options->directory, "folder for records, tables and figures")->capture_default_str();
  command->add_option("--molecules", options->molecules, "only these, separated by commas")->delimiter(',');
  command
      ->add_option("--methods", options->methods,
                   "names from the list above or from `smopt methods`, separated by commas, or all by itself")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--repeats", options->repeats, "how often everything that is timed is run")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--quick", options->is_quick, "small molecules only, one repeat");
  command->add_flag("--keep-meshes", options->keeps_meshes, "write each case's mesh too");
  command
      ->add_option("--solvation-memory", options->solvation_memory_bytes,
                   "memory that computing one solvation energy may take, such as 4GB; a case that needs more is a row that says so [12GB]")
      ->transform(CLI::AsSizeValue(false));
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace smopt::cli
