#pragma once

#include <string_view>

/// Files of this folder that are part of the program.
namespace smopt::experiments::embedded {

std::string_view published_json();  ///< published.json
std::string_view study_text();      ///< study.md

}  // namespace smopt::experiments::embedded
