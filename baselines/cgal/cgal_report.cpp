#include "baselines/cgal/cgal_report.h"

namespace smopt::baselines {

MethodOption switch_option(std::string name, bool is_on, std::string help) {
  return {std::move(name), MethodOption::Kind::choice, is_on ? "on" : "off", "", std::move(help), {"on", "off"}};
}

bool is_on(const OptionValues& values, const std::string& name) {
  return values.text(name) == "on";
}

void report_cgal_rounds(MethodReport& report, int rounds) {
  report.rounds_run = static_cast<std::size_t>(rounds);
  report.stopped_because = "rounds";
  report.notes.emplace_back("CGAL does not say how many vertices it moved: moves are counted as none.");
}

}  // namespace smopt::baselines
