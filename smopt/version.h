#pragma once

#include <string_view>

namespace smopt {

/// The project's version, "0.1.0".
std::string_view version();

}  // namespace smopt
