#pragma once

#include <span>
#include <string>

#include "metrics/measure.h"

namespace smopt::metrics {

/// One column of the table.
struct NamedMeasurement {
  std::string name;
  Measurement measurement;
};

/// A text table with the meshes as columns and the registered metrics as rows, aligned for a terminal; "–" where a number does not exist,
/// with the notes below. Rows about the distance to a reference are shown only when one of the meshes has them. Ends in a line feed.
std::string format_table(std::span<const NamedMeasurement> meshes);

}  // namespace smopt::metrics
