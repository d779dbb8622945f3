// smopt-solvation-study: what the Poisson–Boltzmann solver gives. See --help.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "experiments/solvation_study/study_json.h"
#include "experiments/solvation_study/study_markdown.h"
#include "experiments/study_program.h"

namespace smopt::experiments {
namespace {

struct Arguments {
  std::vector<std::string> refined = {"fas2"};
  std::vector<std::string> molecules = {"fas2", "ache-monomer"};
  std::filesystem::path output;
  SolvationStudyOptions study;
  int threads = 0;
};

constexpr const char* kHelp =
    "Solves the linearised Poisson–Boltzmann equation on spheres whose energy is known, on a molecule's surface at three spacings, and on "
    "the\n"
    "initial and the improved mesh of molecules, and says what of it is as it should be. Writes solvation.md and solvation.json into a "
    "folder,\n"
    "or the page to standard output.\n"
    "\n"
    "Example: smopt-solvation-study -o results --apbs\n"
    "         smopt-solvation-study --divisions 3,4,5 --refined fas2 --molecules fas2";

/// What was given beyond the defaults.
std::string command_of(const Arguments& arguments) {
  const Arguments defaults;
  std::string command = "build/release/bin/smopt-solvation-study -o results";
  if (arguments.study.with_apbs) command += " --apbs";
  if (arguments.study.sphere_divisions != defaults.study.sphere_divisions)
    command += fmt::format(" --divisions {}", fmt::join(arguments.study.sphere_divisions, ","));
  if (arguments.refined != defaults.refined) command += fmt::format(" --refined {}", fmt::join(arguments.refined, ","));
  if (arguments.study.coarsest_spacing != defaults.study.coarsest_spacing)
    command += fmt::format(" --coarsest {}", arguments.study.coarsest_spacing);
  if (arguments.study.refinement != defaults.study.refinement) command += fmt::format(" --ratio {}", arguments.study.refinement);
  if (arguments.molecules != defaults.molecules) command += fmt::format(" --molecules {}", fmt::join(arguments.molecules, ","));
  return command;
}

/// Born's ion without salt and with AFMPB's.
std::vector<BornSeries> study_spheres(const std::vector<int>& divisions, const StudyLog& log) {
  std::vector<BornSeries> born;
  for (const double ionic_strength : {0.0, metrics::DielectricModel().ionic_strength}) {
    BornIon ion;
    ion.medium.ionic_strength = ionic_strength;
    born.push_back(study_born(ion, divisions, log));
  }
  return born;
}

/// "none" is no molecule.
std::vector<Dataset> chosen(const std::vector<std::string>& names) {
  if (names == std::vector<std::string>{"none"}) return {};
  return find_datasets(all_datasets(), names);
}

void run(const Arguments& arguments) {
  const std::vector<Dataset> refined = chosen(arguments.refined), compared = chosen(arguments.molecules);
  std::optional<tbb::global_control> limit;
  if (arguments.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.threads));
  const StudyLog log = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
  SolvationStudy study;
  study.born = study_spheres(arguments.study.sphere_divisions, log);
  for (const Dataset& dataset : refined) study.refinements.push_back(study_refinement(dataset, arguments.study, log));
  for (const Dataset& dataset : compared) study.comparisons.push_back(compare_meshes(dataset, arguments.study, log));
  const std::string page = study_markdown(study, command_of(arguments));
  write_study(arguments.output, "solvation", page, study_json(study).dump(1) + "\n");
}

int main_of(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(kHelp, "smopt-solvation-study");
  app.add_option("--divisions", arguments.study.sphere_divisions, "of the icospheres' triangles")
      ->delimiter(',')
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  app.add_option("--refined", arguments.refined, "molecules at three spacings, or none")->delimiter(',')->capture_default_str();
  app.add_option("--coarsest", arguments.study.coarsest_spacing, "the first of the three, ångström")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--ratio", arguments.study.refinement, "from each spacing to the next")
      ->check(CLI::Range(1.05, 4.0))
      ->capture_default_str();
  app.add_option("--molecules", arguments.molecules, "molecules whose initial and improved meshes are compared, or none")
      ->delimiter(',')
      ->capture_default_str();
  app.add_flag("--apbs", arguments.study.with_apbs, "lay energies by APBS beside ours, where it is installed (Debian: apbs)");
  app.add_option("-o,--output", arguments.output, "the folder to write into (default: the page to standard output)");
  app.add_option("--threads", arguments.threads, "threads to use (default: all cores)")->check(CLI::Range(1, 1024));
  return run_study_program(app, argc, argv, [&] { run(arguments); });
}

}  // namespace
}  // namespace smopt::experiments

int main(int argc, char** argv) {
  return smopt::experiments::main_of(argc, argv);
}
