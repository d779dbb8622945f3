#include "experiments/figures/python.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "smopt/error.h"
#include "smopt/io/child_process.h"

namespace smopt::experiments {
namespace {

std::string python() {
  const char* given = std::getenv("SMOPT_PYTHON");
  return given != nullptr && *given != '\0' ? given : "/usr/bin/python3";
}

}  // namespace

std::string run_python(const std::vector<std::string>& arguments, double time_limit_seconds, const ProgressCallback& progress) {
  std::vector<std::string> command = {python()};
  if (!std::filesystem::exists(command.front()))
    throw InvalidInput(fmt::format("figures: {} does not exist (Debian package python3-matplotlib; or set SMOPT_PYTHON)", command.front()));
  command.insert(command.end(), arguments.begin(), arguments.end());
  const ProcessOutcome outcome = run_process(command, {time_limit_seconds, 0}, "figures", progress);
  if (outcome.exit_status != 0) throw InvalidInput(fmt::format("figures: {} failed: {}", command.front(), outcome.output));
  return outcome.output;
}

}  // namespace smopt::experiments
