#include "experiments/figures/figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "experiments/figures/figure4_input.h"
#include "experiments/figures/programs.h"
#include "experiments/figures/python.h"
#include "smopt/io/file.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::experiments {
namespace {

/// Thirty molecules and Figure 4 of a million vertices take minutes; much longer is a Python that hangs.
constexpr double kTimeLimitSeconds = 3600;
constexpr std::string_view kNote = "note: ";  ///< before what plot.py has to tell

std::vector<std::string> notes_in(const std::string& output) {
  std::vector<std::string> notes;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(kNote)) notes.push_back(line.substr(kNote.size()));
  return notes;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

}  // namespace

void write_figure_programs(const std::filesystem::path& folder) {
  for (const auto& [name, text] : embedded::figure_programs()) write_file(folder / name, text);
}

std::vector<std::string> draw_figures(const RecordSet& records, const std::filesystem::path& directory, const ProgressCallback& progress,
                                      const FigureOptions& options) {
  const std::string molecule = figure4_molecule(records, options.figure4_molecule);
  const ScratchFolder folder("figures");
  write_figure_programs(folder / "");
  std::vector<std::string> arguments = {(folder / "plot.py").string(),
                                        directory.string(),
                                        "--molecules",
                                        joined(records.molecules()),
                                        "--methods",
                                        joined(paper_methods(records)),
                                        "--compared",
                                        joined(records.methods())};
  std::vector<std::string> notes;
  if (const auto input = figure4_input(directory, molecule, folder)) {
    write_file(folder / "figure4.json", input->dump());
    arguments.insert(arguments.end(), {"--figure4", (folder / "figure4.json").string()});
  } else {
    notes.push_back(fmt::format("figure 4 is left out: the run has kept no meshes of {} (smopt reproduce --keep-meshes)", molecule));
  }
  for (std::string& note : notes_in(run_python(arguments, kTimeLimitSeconds, progress))) notes.push_back(std::move(note));
  return notes;
}

}  // namespace smopt::experiments
