#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "metrics/measure.h"

namespace smopt::metrics {

/// Which way a metric gets better.
enum class Better { kHigher, kLower, kNeutral };

/// One number about a mesh. metrics/README.md has a card for each.
struct Metric {
  std::string_view name;   ///< its path in the JSON: "angle_deg.min"
  std::string_view title;  ///< a few words for tables and figures
  std::string_view unit;  ///< "Å", "Å²", "Å³", "°", "count", "share" (a fraction in [0, 1]), "yes/no" (1 or 0), "1" (any other number)
  std::optional<double> ideal;  ///< the value of a perfect mesh, where there is one
  Better better;
  std::optional<double> (*value)(const Measurement&);  ///< empty where the number does not exist
};

/// All metrics, in the order in which tables show them.
std::span<const Metric> metric_registry();

/// The metric of that name, or null.
const Metric* find_metric(std::string_view name);

}  // namespace smopt::metrics
