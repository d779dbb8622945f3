#pragma once

#include <string_view>

/// Files of this folder that are part of the program, so that it finds them wherever it is installed.
namespace smopt::experiments::embedded {

std::string_view datasets_json();    ///< datasets.json
std::string_view methods_json();     ///< methods.json
std::string_view paper_table1();     ///< paper/table1.csv
std::string_view paper_table2();     ///< paper/table2.csv
std::string_view paper_table3();     ///< paper/table3.csv
std::string_view claims_json();      ///< claims/claims.json
std::string_view tolerances_json();  ///< regression/tolerances.json

}  // namespace smopt::experiments::embedded
