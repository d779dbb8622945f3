#include "smopt/surface/positive_option.h"

#include <fmt/format.h>

#include <cmath>

#include "smopt/error.h"

namespace smopt {

void require_positive(double value, std::string_view name) {
  if (!(std::isfinite(value) && value > 0)) throw InvalidOption(fmt::format("{} must be positive and finite, not {}", name, value));
}

}  // namespace smopt
