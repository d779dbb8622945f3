#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "experiments/regression/accept.h"
#include "experiments/regression/compare.h"
#include "experiments/regression/comparison_text.h"
#include "experiments/regression/tolerance.h"
#include "smopt/cli/command.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string run;
  std::string reference;
  std::string tolerances;
  std::vector<std::string> molecules;
  bool complete = false;
  bool accept = false;
  bool is_json = false;
};

std::vector<experiments::Tolerance> tolerances_of(const Arguments& arguments) {
  if (arguments.tolerances.empty()) return experiments::default_tolerances();
  return experiments::parse_tolerances(read_file(arguments.tolerances), arguments.tolerances);
}

/// Before anything is printed.
void require_two_folders(const Arguments& arguments) {
  std::error_code ignored;
  if (fs::equivalent(arguments.run, arguments.reference, ignored))
    throw InvalidOption(fmt::format("{}: a run cannot be accepted as its own reference", arguments.run));
}

experiments::RecordSet records_in(const std::string& folder, const Arguments& arguments) {
  auto records = experiments::RecordSet::load(folder);
  return arguments.molecules.empty() ? records : records.of_molecules(arguments.molecules);
}

void require_known_molecules(const Arguments& arguments, const experiments::RecordSet& run, const experiments::RecordSet& reference) {
  for (const std::string& name : arguments.molecules)
    if (!run.has(name) && !reference.has(name))
      throw InvalidInput(fmt::format("neither {} nor {} has records of a molecule '{}'", arguments.run, arguments.reference, name));
}

experiments::Comparison compare_runs(const Arguments& arguments) {
  const auto tolerances = tolerances_of(arguments);
  const auto run = records_in(arguments.run, arguments);
  const auto reference = records_in(arguments.reference, arguments);
  require_known_molecules(arguments, run, reference);
  experiments::Comparison comparison = experiments::compare(run, reference, tolerances);
  if (comparison.compared.empty() && !arguments.accept)
    throw InvalidInput(fmt::format("{}: has no case that {} has: nothing was compared", arguments.run, arguments.reference));
  return comparison;
}

std::string accepted_text(const std::vector<experiments::CaseName>& cases, const std::string& reference) {
  std::string text = fmt::format("accepted: {} records of {} changed\n", cases.size(), reference);
  for (const experiments::CaseName& name : cases) text += fmt::format("  {}, {}\n", name.molecule, name.method);
  return text;
}

nlohmann::ordered_json accepted_json(const std::vector<experiments::CaseName>& cases) {
  auto json = nlohmann::ordered_json::array();
  for (const experiments::CaseName& name : cases) json.push_back({{"molecule", name.molecule}, {"method", name.method}});
  return json;
}

void run(const Arguments& arguments, Context& context) {
  if (arguments.accept) require_two_folders(arguments);
  const experiments::Comparison comparison = compare_runs(arguments);
  std::vector<experiments::CaseName> accepted;
  if (arguments.accept) accepted = experiments::accept(arguments.run, arguments.reference, comparison);
  if (arguments.is_json) {
    nlohmann::ordered_json json = experiments::to_json(comparison, arguments.complete);
    if (arguments.accept) json["accepted"] = accepted_json(accepted);
    fmt::print("{}\n", json.dump(2));
  } else {
    if (arguments.accept) fmt::print("{}\n", accepted_text(accepted, arguments.reference));
    fmt::print("{}", experiments::to_text(comparison, arguments.complete));
  }
  if (!arguments.accept && experiments::is_red(comparison, arguments.complete)) context.exit_code = ExitCode::answer_is_no;
}

}  // namespace

void add_regress(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("regress", "Hold a run against a reference: is a quality number worse?");
  command->footer(
      "Cases that both have are compared, value by value, with the tolerances of experiments/regression/tolerances.json. Times and memory "
      "are\n"
      "shown and never count. Exit code 1 where something is worse by more than its tolerance.\n"
      "\n"
      "Examples:\n"
      "  smopt regress results/run results/reference\n"
      "  smopt regress results/run results/quick --complete       (none of its cases may be missing)\n"
      "  smopt regress results/run results/quick --accept         (these are the numbers from now on)");
  command->add_option("run", arguments->run, "the folder that `smopt reproduce` wrote")->required();
  command->add_option("reference", arguments->reference, "the folder of the run that it is held against")->required();
  command->add_flag("--complete", arguments->complete, "a case of the reference that the run lacks counts as worse");
  command->add_flag("--accept", arguments->accept,
                    "make the run's records those of the reference, better and worse, and say which changed; exit code 0");
  command->add_option("--molecules", arguments->molecules, "only the cases of these, separated by commas")->delimiter(',');
  command->add_option("--tolerances", arguments->tolerances, "tolerances of your own, a file of the same form");
  command->add_flag("--json", arguments->is_json, "as JSON");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
