// smopt-generator-study: how the generated surfaces converge, and why their topology changes on the way. See --help.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/convergence/study_json.h"
#include "experiments/convergence/study_markdown.h"
#include "experiments/study_program.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

struct Arguments {
  std::vector<std::string> molecules;
  std::vector<std::filesystem::path> also;
  std::filesystem::path output;
  StudyOptions study;
  int threads = 0;
};

constexpr const char* kHelp =
    "Meshes molecules at errors E, E/2, E/4, … and on uniform grids, and shows what converges: area, volume, topology, distance to the "
    "level\n"
    "set. Every change of topology from one error to the next is located and laid beside the critical points of the field there. Writes\n"
    "generator.md and generator.json into a folder, or the page to standard output.\n"
    "\n"
    "Example: smopt-generator-study -o results --also connexin_2zw3.pqr.gz\n"
    "         smopt-generator-study --molecules fas2 --errors 1,0.5,0.25";

/// The molecule's name: the file's without its endings.
std::string stem_of(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.substr(0, name.find('.'));
}

/// How a molecule is called that is not in the experiments' list.
std::string title_of(const std::string& name) {
  for (const PublishedMesh& mesh : published_figures().meshes) {
    if (mesh.molecule == name) return mesh.title;
  }
  return name;
}

std::vector<Dataset> chosen_datasets(const Arguments& arguments) {
  std::vector<Dataset> chosen = arguments.molecules.empty() ? all_datasets() : find_datasets(all_datasets(), arguments.molecules);
  for (const std::filesystem::path& path : arguments.also) {
    Dataset& dataset = chosen.emplace_back();
    dataset.name = stem_of(path);
    dataset.title = title_of(dataset.name);
    dataset.path = path;
  }
  return chosen;
}

void require_halves(const std::vector<double>& errors) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i] > 0)) throw InvalidOption(fmt::format("an error must be positive, not {}", errors[i]));
    if (i > 0 && !(errors[i] < errors[i - 1])) throw InvalidOption("errors must become smaller");
  }
}

/// The command line with the files' names only.
std::string command_of(const Arguments& arguments) {
  std::string command = "build/release/bin/smopt-generator-study -o results";
  if (!arguments.molecules.empty()) command += fmt::format(" --molecules {}", fmt::join(arguments.molecules, ","));
  if (arguments.study.errors != StudyOptions{}.errors) command += fmt::format(" --errors {}", fmt::join(arguments.study.errors, ","));
  for (const std::filesystem::path& path : arguments.also) command += " --also " + path.filename().string();
  return command;
}

void run(const Arguments& arguments) {
  require_halves(arguments.study.errors);
  std::optional<tbb::global_control> limit;
  if (arguments.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.threads));
  std::vector<MoleculeStudy> studies;
  for (const Dataset& dataset : chosen_datasets(arguments))
    studies.push_back(study_molecule(dataset, arguments.study, [](const std::string& what) { fmt::print(stderr, "{}\n", what); }));
  const std::string page = study_markdown(studies, command_of(arguments));
  write_study(arguments.output, "generator", page, study_json(studies).dump(1) + "\n");
}

int main_of(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(kHelp, "smopt-generator-study");
  app.add_option("--molecules", arguments.molecules, "names from the experiments' list (default: all)")->delimiter(',');
  app.add_option("--also", arguments.also, "files of further molecules, decay 0.6, isovalue 1")->check(CLI::ExistingFile);
  app.add_option("--errors", arguments.study.errors, "ångström, each smaller than the one before")->delimiter(',')->capture_default_str();
  app.add_option("-o,--output", arguments.output, "the folder to write into (default: the page to standard output)");
  app.add_option("--threads", arguments.threads, "threads to use (default: all cores)")->check(CLI::Range(1, 1024));
  return run_study_program(app, argc, argv, [&] { run(arguments); });
}

}  // namespace
}  // namespace smopt::experiments

int main(int argc, char** argv) {
  return smopt::experiments::main_of(argc, argv);
}
