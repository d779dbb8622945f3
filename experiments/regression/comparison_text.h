#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/regression/compare.h"

namespace smopt::experiments {

/// The comparison as people read it: a line for every value that is worse, then the better ones, what never gates, what was not the same or not
/// asked for, the cases that only one of the two has, and last one line that says how it stands.
std::string to_text(const Comparison& comparison, bool complete);

/// The same for programs: "verdict" ("green", "red"), "worse", "better", "shown", "changed", "not_compared", "only_in_run", "only_in_reference",
/// "cases" and "values" (how many were compared).
nlohmann::ordered_json to_json(const Comparison& comparison, bool complete);

}  // namespace smopt::experiments
