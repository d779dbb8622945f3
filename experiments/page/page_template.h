#pragma once

#include <string_view>

namespace smopt::experiments {

/// The page's program, styles and empty body in one HTML text, as the build bundled them from app/; empty where it could not.
std::string_view page_template();

/// Why `page_template` is empty: "npm was not found"; empty where it is not.
std::string_view why_no_page_template();

}  // namespace smopt::experiments
