#pragma once

#include <string>

#include "experiments/tables/table.h"

namespace smopt::experiments {

/// The table as a LaTeX `table` environment to be \\input; the document loads booktabs and graphicx (a wide table is scaled to the text's
/// width). A missing value is an em dash.
std::string to_latex(const Table& table);

}  // namespace smopt::experiments
