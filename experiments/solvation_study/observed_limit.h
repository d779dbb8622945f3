#pragma once

#include <optional>

namespace smopt::experiments {

/// What a quantity tends to as the spacing goes to zero, at the order that its values show.
struct ObservedLimit {
  double value = 0;
  double order = 0;     ///< p of value + c·h^p through the three values; positive
  double distance = 0;  ///< of the finest value from the limit, relative to the limit
};

/// Richardson's extrapolation from values at spacings ratio²·h, ratio·h and h. Nothing where the second difference is not smaller than the first and
/// of its sign: then the values do not show that they converge. \pre ratio > 1.
std::optional<ObservedLimit> observed_limit(double coarse, double middle, double fine, double ratio);

}  // namespace smopt::experiments
