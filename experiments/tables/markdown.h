#pragma once

#include <string>

#include "experiments/tables/table.h"

namespace smopt::experiments {

/// The table in GitHub-flavoured Markdown: caption, table with aligned source, notes. A missing value is "—".
std::string to_markdown(const Table& table);

}  // namespace smopt::experiments
