#pragma once

#include <nlohmann/json.hpp>

#include "metrics/measure.h"

namespace smopt::metrics {

/// The object that `smopt measure --json` prints and that records hold: keys in the order of the documentation, null where a number does
/// not exist, and `notes` (an array of strings) saying why. `distance` is there only when a reference was given.
nlohmann::ordered_json to_json(const Measurement& measurement);

}  // namespace smopt::metrics
