#pragma once

#include <nlohmann/json.hpp>

#include "metrics/solvation/solvate.h"

namespace smopt::metrics {

/// What `smopt solvate --json` prints: everything but the numbers at the vertices. A number that is not finite is null.
nlohmann::ordered_json to_json(const Solvation& result);

/// Every option that the energy depends on, by its name and unit.
nlohmann::ordered_json to_json(const SolvationOptions& options);

}  // namespace smopt::metrics
