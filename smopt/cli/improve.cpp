#include <fmt/format.h>

#include <memory>

#include "baselines/baselines.h"
#include "experiments/improve_run.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {
namespace {

struct Arguments {
  experiments::ImproveRun run;
  std::string cavities;
  std::string report;
  bool is_json = false;
};

/// The method must be known before the command line is parsed, as its options depend on it.
std::string requested_method(const Context& context) {
  constexpr std::string_view kOption = "--method";
  std::string method = experiments::ImproveRun().method;
  for (int i = 1; i < context.argc; ++i) {
    const std::string_view argument = context.argv[i];
    if (argument == kOption && i + 1 < context.argc) method = context.argv[i + 1];
    if (argument.starts_with("--method=")) method = argument.substr(kOption.size() + 1);
  }
  return method;
}

std::string option_help(const MethodOption& option) {
  std::string help = option.help;
  for (std::size_t i = 0; i < option.choices.size(); ++i) help += (i == 0 ? ": " : ", ") + option.choices[i];
  if (!option.unit.empty()) help += " (" + option.unit + ")";
  return option.default_value.empty() ? help : help + " [" + option.default_value + "]";
}

void add_method_options(CLI::App& command, const Method& method, Arguments& arguments) {
  for (const MethodOption& option : method.options) {
    command
        .add_option_function<std::string>(
            "--" + option.name, [&arguments, name = option.name](const std::string& value) { arguments.run.options[name] = value; },
            option_help(option))
        ->group("Options of " + method.name);
  }
}

void warn_of_rounding(const experiments::ImproveRun& run) {
  if (format_ending(run.output) == "stl" || run.digits > 0)
    fmt::print(stderr, "smopt: warning: {} is written with rounded coordinates, which may make triangles intersect; --verify counts\n",
               run.output.string());
}

void print_summary(const nlohmann::ordered_json& report) {
  fmt::print(stderr, "{}: {} -> {} vertices; {} cavities removed; {} moves, {} shortened, {} refused; {} rounds ({}); {:.2f} s\n",
             report["output"]["file"].get<std::string>(), report["input"]["vertices"].get<long>(), report["output"]["vertices"].get<long>(),
             report["removed"]["cavities"].get<long>(), report["moves"]["accepted"].get<long>(), report["moves"]["shortened"].get<long>(),
             report["moves"]["refused"].get<long>(), report["rounds"].get<long>(), report["stopped_because"].get<std::string>(),
             report["seconds"]["total"].get<double>());
  for (const auto& note : report["notes"]) fmt::print(stderr, "note: {}\n", note.get<std::string>());
  if (!report["diverged_at_step"].is_null())
    fmt::print(stderr, "smopt: warning: the method diverged at step {}; what is written is no surface of use\n",
               report["diverged_at_step"].get<long>());
}

std::string count_text(const std::optional<std::size_t>& pairs) {
  return pairs ? fmt::format("{}", *pairs) : "an unknown number of";
}

/// False, too, where they cannot be counted: coordinates that are not finite, or a tangle.
bool has_no_new_pairs(const experiments::ImproveRunResult& result) {
  return result.pairs_before && result.pairs_after && *result.pairs_after <= *result.pairs_before;
}

/// What would be found out only after the work.
void require_outputs(const Arguments& arguments) {
  const std::string output = arguments.run.output.string();
  if (output == "-" && (arguments.is_json || arguments.report == "-"))
    throw InvalidOption("the mesh and the report cannot both go to standard output");
  require_writable_place(output);
  if (!arguments.report.empty()) require_writable_place(arguments.report);
}

void run(Arguments& arguments, Context& context) {
  require_outputs(arguments);
  if (!arguments.cavities.empty()) arguments.run.cavities = parse_cavity_policy(arguments.cavities);
  if (!context.is_quiet) warn_of_rounding(arguments.run);
  ProgressBar bar(context.is_quiet);
  const experiments::ImproveRunResult result = experiments::run_improvement(arguments.run, bar.callback());
  const std::string report = result.report.dump(2) + "\n";
  if (!arguments.report.empty()) write_file(arguments.report, report);
  if (arguments.is_json) fmt::print("{}", report);
  if (!context.is_quiet) print_summary(result.report);
  if (!arguments.run.verify) return;
  if (!context.is_quiet)
    fmt::print(stderr, "verified: {} intersecting pairs before, {} after\n", count_text(result.pairs_before),
               count_text(result.pairs_after));
  if (!has_no_new_pairs(result)) context.exit_code = ExitCode::answer_is_no;
}

}  // namespace

void add_improve(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("improve", "Improve a surface mesh");
  command->footer(
      "The mesh must be closed and manifold. With nothing but a mesh and -o, this does what the paper did: cavities and redundant points "
      "are\n"
      "deleted, then 100 rounds of Laplacian smoothing whose steps are halved until no two triangles intersect.\n"
      "--method smopt2 changes the connectivity too, and is the one to pick for a simulation: regular triangles everywhere, the volume "
      "kept.\n"
      "`smopt methods` lists all methods with their options; `smopt improve --method NAME --help` shows one method's.\n"
      "\n"
      "Examples:\n"
      "  smopt improve surface.off -o improved.off --report report.json\n"
      "  smopt improve surface.off -o ready.off --method smopt2 --verify\n"
      "  smopt improve surface.ply -o improved.ply --step volume-preserving --verify\n"
      "  smopt improve surface.off -o smooth.off --method laplacian --rounds 10");
  command->add_option("mesh", arguments->run.input, "the mesh (" + mesh_format_names() + ", each also .gz; - for OFF)")->required();
  command->add_option("-o,--output", arguments->run.output, "the mesh to write")->required();
  command->add_option("--method", arguments->run.method, "see `smopt methods`")->capture_default_str();
  command->add_option("--cavities", arguments->cavities, "delete, keep, or main: only the largest component (default: the method's)");
  command->add_option("--report", arguments->report, "write what was done as JSON to this file");
  command
      ->add_option("--repeats", arguments->run.repeats, "how often it is done, for the times in the report: all of them and their medians")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--digits", arguments->run.digits, "significant digits to write (default: enough to read the same doubles back)")
      ->check(CLI::Range(1, 17));
  command->add_flag("--verify", arguments->run.verify, "count intersecting pairs of the file as read back; exit 1 if there are new ones");
  command->add_flag("--json", arguments->is_json, "print the report");
  const std::vector<Method>& methods = baselines::all_methods().all();
  const std::string method = requested_method(context);
  for (const Method& m : methods)
    if (m.name == method) add_method_options(*command, m, *arguments);
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
