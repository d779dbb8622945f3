// smopt-iso2mesh-study: which setting of ISO2mesh keeps area and volume. See --help.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "baselines/baselines.h"
#include "experiments/datasets.h"
#include "experiments/iso2mesh_study/study_markdown.h"
#include "experiments/paper_table.h"
#include "experiments/study_program.h"
#include "experiments/surface_stage.h"
#include "smopt/improve/prepare.h"

namespace smopt::experiments {
namespace {

struct Arguments {
  std::vector<std::string> molecules = {"ache-monomer", "fas2"};
  std::filesystem::path output;
  Iso2meshGrid grid;
};

constexpr const char* kHelp =
    "Runs ISO2mesh's resampling and smoothing on molecules in every setting of a grid and says how far area and volume move: which "
    "setting\n"
    "the paper's Figure 5 may have been made with. Writes iso2mesh.md into a folder, or the page to standard output.\n"
    "\n"
    "Example: smopt-iso2mesh-study -o results\n"
    "         smopt-iso2mesh-study --molecules fas2 --alphas 0.1,0.5 --rounds 0,100";

std::optional<std::size_t> paper_pairs(const Dataset& dataset) {
  constexpr int kTable = 3;
  const auto text = paper_table(kTable).value(dataset.paper_row, "intersecting_pairs_iso2mesh");
  return text ? std::optional<std::size_t>(std::stoul(*text)) : std::nullopt;
}

Iso2meshMoleculeStudy study_molecule(const Dataset& dataset, const Iso2meshGrid& grid) {
  TriangleMesh mesh = generate_surface(dataset, {}).mesh;
  prepare(mesh, CavityPolicy::delete_cavities);
  TriangleMesh improved = mesh;
  const Method& smopt = baselines::all_methods().find("smopt");
  smopt.run(improved, OptionValues(smopt.options, {}), {});
  const auto tell = [&](const std::string& setting) { fmt::print(stderr, "{}: {}\n", dataset.name, setting); };
  return {dataset.title, mesh.vertex_count(), improved.vertex_count(), paper_pairs(dataset),
          run_iso2mesh_study(mesh, improved.vertex_count(), grid, tell)};
}

/// What was given beyond the defaults.
std::string command_of(const Arguments& arguments) {
  const Arguments defaults;
  std::string command = "build/release/bin/smopt-iso2mesh-study -o results";
  if (arguments.molecules != defaults.molecules) command += fmt::format(" --molecules {}", fmt::join(arguments.molecules, ","));
  if (arguments.grid.alphas != defaults.grid.alphas) command += fmt::format(" --alphas {}", fmt::join(arguments.grid.alphas, ","));
  if (arguments.grid.rounds != defaults.grid.rounds) command += fmt::format(" --rounds {}", fmt::join(arguments.grid.rounds, ","));
  return command;
}

void run(const Arguments& arguments) {
  std::vector<Iso2meshMoleculeStudy> studies;
  for (const Dataset& dataset : find_datasets(all_datasets(), arguments.molecules))
    studies.push_back(study_molecule(dataset, arguments.grid));
  const std::string page = study_markdown(studies, command_of(arguments));
  write_study(arguments.output, "iso2mesh", page);
}

int main_of(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(kHelp, "smopt-iso2mesh-study");
  app.add_option("--molecules", arguments.molecules, "names from the experiments' list")->delimiter(',')->capture_default_str();
  app.add_option("--alphas", arguments.grid.alphas, "values of alpha")->delimiter(',')->capture_default_str();
  app.add_option("--rounds", arguments.grid.rounds, "numbers of rounds; 0: the resampling alone")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("-o,--output", arguments.output, "the folder to write into (default: the page to standard output)");
  return run_study_program(app, argc, argv, [&] { run(arguments); });
}

}  // namespace
}  // namespace smopt::experiments

int main(int argc, char** argv) {
  return smopt::experiments::main_of(argc, argv);
}
