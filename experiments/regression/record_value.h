#pragma once

#include <string>
#include <variant>

#include "experiments/record_set.h"
#include "experiments/regression/tolerance.h"

namespace smopt::experiments {

/// What a record says of a quantity: nothing, a number (1 or 0 for yes or no), or a word.
using RecordValue = std::variant<std::monostate, double, std::string>;

/// The quantity's value in a record. Of a relative change: nothing where it has nothing to be held against.
RecordValue value_of(const RecordSet::Json& record, const Tolerance& tolerance);

/// As people read it: "0.12 %" for a share, "yes" for a flag, "nothing" where there is no value.
std::string text_of(const RecordValue& value, const std::string& unit);

}  // namespace smopt::experiments
