#pragma once

#include <string_view>

/// Files of this folder that are part of the program.
namespace smopt::experiments::embedded {

std::string_view ablation_json();          ///< ablation.json
std::string_view plot_ablation_program();  ///< plot_ablation.py

}  // namespace smopt::experiments::embedded
