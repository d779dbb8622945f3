#pragma once

#include <span>
#include <string_view>

namespace smopt::experiments::embedded {

struct ProgramFile {
  std::string_view name;  ///< "plot.py"
  std::string_view text;
};

/// The Python program that draws the figures: plot.py, which is the one to run, and what it imports from its own folder.
std::span<const ProgramFile> figure_programs();

}  // namespace smopt::experiments::embedded
