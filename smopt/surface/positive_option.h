#pragma once

#include <string_view>

namespace smopt {

/// \throws InvalidOption that names the option unless the value is positive and finite.
void require_positive(double value, std::string_view name);

}  // namespace smopt
