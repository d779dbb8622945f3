#pragma once

#include <string>

#include "experiments/tables/table.h"

namespace smopt::experiments {

/// The table as comma-separated values (RFC 4180, lines end in a line feed), columns by their ids; a missing value is an empty field.
/// Caption and notes are left out.
std::string to_csv(const Table& table);

}  // namespace smopt::experiments
