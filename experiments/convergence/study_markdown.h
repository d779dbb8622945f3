#pragma once

#include <span>
#include <string>

#include "experiments/convergence/molecule_study.h"

namespace smopt::experiments {

/// The study as a page of Markdown: study.md with the tables in it. \param command  how the page is made again
std::string study_markdown(std::span<const MoleculeStudy> studies, const std::string& command);

}  // namespace smopt::experiments
