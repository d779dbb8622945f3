#pragma once

#include <string>
#include <vector>

#include "experiments/iso2mesh_study/study.h"

namespace smopt::experiments {

/// What the study found for one molecule.
struct Iso2meshMoleculeStudy {
  std::string title;
  std::size_t vertices_given = 0;          ///< of the initial mesh without its cavities
  std::size_t vertices_asked = 0;          ///< of SMOPT's result
  std::optional<std::size_t> paper_pairs;  ///< intersecting pairs that the paper counts for ISO2mesh; empty: it has no such molecule
  std::vector<Iso2meshOutcome> outcomes;
};

/// "midpoint, laplacian, alpha 0.5, 100 rounds"
std::string describe(const Iso2meshSetting& setting);

/// The page results/iso2mesh.md: for each molecule which setting keeps area and volume best, what the paper's setting does, and all settings.
/// \param command  by which the page was made.
std::string study_markdown(const std::vector<Iso2meshMoleculeStudy>& studies, const std::string& command);

}  // namespace smopt::experiments
