#pragma once

#include <string>

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// An option that is on or off.
MethodOption switch_option(std::string name, bool is_on, std::string help);

/// Whether a `switch_option` is on.
bool is_on(const OptionValues& values, const std::string& name);

/// Fills the rounds of a report; how many vertices moved in them CGAL does not say, and a note says that.
void report_cgal_rounds(MethodReport& report, int rounds);

}  // namespace smopt::baselines
