#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/record_set.h"
#include "smopt/progress.h"

namespace smopt::experiments {

struct FigureOptions {
  std::string figure4_molecule;  ///< name; empty: the AChE monomer, or the first where the run does not have it
};

/// Draws the paper's figures 5 (area and volume), 6 (edge ratios) and 7 (angles), and one of all methods (smallest angle, share below 30°,
/// distance to the level set, intersecting pairs, time), from `directory`/records into `directory`/figures, as SVG and PNG, by Python and
/// matplotlib; and from the meshes that the run has kept Figure 4, rendered by POV-Ray. The same files for the same run.
///
/// The Python is /usr/bin/python3, Debian's, or the one that the environment variable SMOPT_PYTHON names; POV-Ray is found on the path, or
/// where SMOPT_POVRAY says. Figure 4 is left out, and one of an earlier time left as it is, where the run has none of its meshes or there is
/// no POV-Ray. \param records  those of `directory`; they give the order of molecules and methods.
/// \return a line for each figure that was left out: why, and what brings it.
/// \throws InvalidInput with what Python said; when matplotlib is missing it names the package. InvalidOption when the run has no such
/// molecule. Cancelled.
std::vector<std::string> draw_figures(const RecordSet& records, const std::filesystem::path& directory,
                                      const ProgressCallback& progress = {}, const FigureOptions& options = {});

/// Writes the Python program that draws into `folder`, a file each of embedded::figure_programs(); plot.py is the one to run.
void write_figure_programs(const std::filesystem::path& folder);

}  // namespace smopt::experiments
