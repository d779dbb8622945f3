// smopt-remesh-study: what smopt2 gives. See --help.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "baselines/baselines.h"
#include "experiments/figures/figures.h"
#include "experiments/record_set.h"
#include "experiments/remesh_study/study.h"
#include "experiments/remesh_study/study_mesh.h"
#include "experiments/run_layout.h"
#include "experiments/study_program.h"
#include "smopt/io/scratch_folder.h"
#include "smopt/timing.h"

namespace smopt::experiments {
namespace {

struct Arguments {
  std::vector<std::string> molecules;
  std::vector<std::string> compared = {"fas2", "ache-monomer"};
  std::filesystem::path data, output;
  bool with_million = true;
  RemeshStudyOptions study;
};

constexpr const char* kHelp =
    "Improves molecules' meshes and ready meshes by smopt2, holds the results against its goals, and lays every other method, and smopt2 "
    "without\n"
    "one of its operations, beside it. Writes smopt2.md, smopt2.json and a figure into a folder, or the page to standard output.\n"
    "\n"
    "Example: smopt-remesh-study -o results --demo /usr/share/doc/libcgal-dev/data.tar.gz\n"
    "         smopt-remesh-study --molecules fas2 --compared fas2";

/// "none" is no molecule.
bool is_none(const std::vector<std::string>& names) {
  return names == std::vector<std::string>{"none"};
}

std::vector<std::string> names_of(const std::vector<Dataset>& datasets) {
  std::vector<std::string> names;
  for (const Dataset& dataset : datasets) names.push_back(dataset.name);
  return names;
}

std::vector<Dataset> chosen_datasets(const Arguments& arguments) {
  std::vector<Dataset> datasets;
  if (!is_none(arguments.molecules)) datasets = find_datasets(all_datasets(), arguments.molecules);
  if (arguments.data.empty()) return datasets;
  for (Dataset& dataset : datasets_in(arguments.data)) datasets.push_back(std::move(dataset));
  return datasets;
}

/// The default is those of the default that are among the molecules.
std::vector<std::string> chosen_compared(const Arguments& arguments) {
  if (is_none(arguments.compared)) return {};
  std::vector<std::string> compared = arguments.compared;
  const std::vector<std::string> names = names_of(arguments.study.datasets);
  if (compared == Arguments().compared)
    std::erase_if(compared, [&](const std::string& name) { return std::ranges::find(names, name) == names.end(); });
  return compared;
}

/// What was given beyond the defaults.
std::string command_of(const Arguments& arguments) {
  const Arguments defaults;
  std::string command = "build/release/bin/smopt-remesh-study -o results";
  if (arguments.molecules != names_of(all_datasets())) command += fmt::format(" --molecules {}", fmt::join(arguments.molecules, ","));
  if (arguments.compared != defaults.compared) command += fmt::format(" --compared {}", fmt::join(arguments.compared, ","));
  if (!arguments.data.empty()) command += fmt::format(" --data {}", arguments.data.filename().string());
  if (!arguments.study.meshes.empty()) command += fmt::format(" --meshes {}", arguments.study.meshes.filename().string());
  if (!arguments.study.archive.empty()) command += fmt::format(" --demo {}", arguments.study.archive.string());
  if (arguments.study.method != defaults.study.method) command += fmt::format(" --method {}", arguments.study.method);
  if (!arguments.study.with_solvation) command += " --no-solvation";
  if (!arguments.with_million) command += " --no-million";
  return command;
}

/// Of the compared records, drawn by the program that draws a run's. \return the file beside the page.
std::string draw_figure(const RemeshStudy& study, const std::filesystem::path& folder) {
  const std::string name = "smopt2-methods";
  const ScratchFolder run("figure");
  RecordSet records;
  for (const Json& record : study.compared) {
    records.add(record, "the study");
    const std::filesystem::path file =
        record_path(run / ".", record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
    std::filesystem::create_directories(file.parent_path());
    write_file(file, record.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  draw_figures(records, run / ".");
  std::filesystem::create_directories(folder);
  for (const char* ending : {".svg", ".png"})
    std::filesystem::copy_file(run / "figures" / (std::string("methods") + ending), folder / (name + ending),
                               std::filesystem::copy_options::overwrite_existing);
  return name + ".svg";
}

void run(Arguments& arguments) {
  arguments.study.datasets = chosen_datasets(arguments);
  arguments.study.compared = chosen_compared(arguments);
  if (!arguments.with_million) arguments.study.copied_vertices = 0;
  const Stopwatch watch;
  const RemeshStudyLog tell = [&](const std::string& what) { fmt::print(stderr, "[{:5.0f} s] {}\n", watch.elapsed().wall, what); };
  RemeshStudy study = run_remesh_study(arguments.study, baselines::all_methods(), tell);
  if (!arguments.output.empty() && !study.compared.empty()) study.figure = draw_figure(study, arguments.output);
  const std::string json = study_json(study).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  write_study(arguments.output, "smopt2", study_page(study, command_of(arguments)), json);
}

int main_of(int argc, char** argv) {
  Arguments arguments;
  arguments.molecules = names_of(all_datasets());
  CLI::App app(kHelp, "smopt-remesh-study");
  app.add_option("--molecules", arguments.molecules, "names from the experiments' list, or none")->delimiter(',')->capture_default_str();
  app.add_option("--compared", arguments.compared, "those of them on which every method is run, or none")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--data", arguments.data, "a folder of more molecules (.pqr, .pqr.gz)");
  app.add_option("--meshes", arguments.study.meshes, "a folder of ready meshes (.off)");
  app.add_option("--demo", arguments.study.archive,
                 "an archive of ready meshes (.tar.gz), of which the clean, smooth, closed ones are taken");
  app.add_option("--method", arguments.study.method, "the method that is studied")->capture_default_str();
  app.add_flag("!--no-solvation", arguments.study.with_solvation, "leave the solvation solver out");
  app.add_flag("!--no-million", arguments.with_million, "leave out the copies of the AChE monomer with a million vertices");
  app.add_option("-o,--output", arguments.output, "the folder to write into (default: the page to standard output)");
  return run_study_program(app, argc, argv, [&] { run(arguments); });
}

}  // namespace
}  // namespace smopt::experiments

int main(int argc, char** argv) {
  return smopt::experiments::main_of(argc, argv);
}
