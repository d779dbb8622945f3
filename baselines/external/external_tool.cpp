#include "baselines/external/external_tool.h"

#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <cstdlib>

#include "baselines/divergence_watch.h"
#include "smopt/error.h"

namespace smopt::baselines {
namespace {

namespace fs = std::filesystem;

constexpr double kTimeLimitSeconds = 600;  ///< minutes are much for what takes our own code seconds
constexpr int kMemoryLimitMb = 8192;       ///< as for TetGen; MeshLab and Octave want 1000 for themselves
constexpr double kGraceSeconds = 2;        ///< Xvfb removes its lock and its socket in some milliseconds
constexpr int kShellSignalBase = 128;      ///< a shell's exit status for a program that a signal ended is this and the signal's number

bool is_program(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

std::string name_of_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("{}", signal);
}

/// ": " and the last line that is not empty; nothing where there is none.
std::string last_line(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  text = text.substr(0, text.find_last_not_of(kBlank) + 1);
  text.remove_prefix(text.rfind('\n') + 1);  // npos + 1 is 0
  return text.empty() ? std::string() : fmt::format(": {}", text);
}

/// How much memory it was allowed, where that was limited: a crash may come from it, and nobody says so.
std::string allowance(const ProcessLimits& limits) {
  return limits.memory_mb > 0 ? fmt::format(" with {} MB allowed", limits.memory_mb) : std::string();
}

/// Empty when the process ended by itself and content.
std::string why_failed(const ProcessOutcome& outcome, const ProcessLimits& limits) {
  if (outcome.out_of_time) return fmt::format("ran out of its {:g} s", limits.seconds);
  const std::string line = last_line(outcome.output);
  if (outcome.signal) return fmt::format("was ended by signal {}{}{}", name_of_signal(*outcome.signal), allowance(limits), line);
  const int status = outcome.exit_status.value_or(-1);
  if (status == 0) return {};
  if (sigabbrev_np(status - kShellSignalBase) == nullptr) return fmt::format("ended with exit status {}{}", status, line);
  return fmt::format("ended with exit status {} (signal {}){}{}", status, name_of_signal(status - kShellSignalBase), allowance(limits),
                     line);
}

TriangleMesh read_result(const ToolRun& run, const ProcessOutcome& outcome) {
  std::error_code ignored;
  if (!fs::exists(run.result, ignored)) throw MethodFailed(fmt::format("{}: gave no mesh{}", run.method, last_line(outcome.output)));
  try {
    return run.read(run.result);
  } catch (const InvalidInput& error) {
    throw MethodFailed(fmt::format("{}: gave what is no mesh: {}", run.method, error.what()));
  }
}

}  // namespace

std::optional<fs::path> find_program(std::string_view name) {
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable != nullptr ? variable : "";
  while (!folders.empty()) {
    const std::string_view folder = folders.substr(0, folders.find(':'));
    folders.remove_prefix(std::min(folders.size(), folder.size() + 1));
    const fs::path path = fs::current_path() / folder / name;  // an empty entry is the working directory
    if (is_program(path)) return path;
  }
  return std::nullopt;
}

fs::path require_program(std::string_view method, std::string_view name, std::string_view how_to_get) {
  if (const std::optional<fs::path> found = find_program(name)) return *found;
  throw NotInstalled(fmt::format("{}: {} is not installed ({})", method, name, how_to_get));
}

std::vector<MethodOption> with_limit_options(std::vector<MethodOption> options) {
  using Kind = MethodOption::Kind;
  options.push_back(
      {"time-limit", Kind::number, fmt::format("{}", kTimeLimitSeconds), "s", "wall time after which the tool is killed", {}});
  options.push_back({"memory-limit", Kind::integer, fmt::format("{}", kMemoryLimitMb), "MB", "address space of the tool; 0: no limit", {}});
  return options;
}

ProcessLimits limits_of(const OptionValues& values) {
  const double seconds = values.number("time-limit", 0);
  if (seconds == 0) throw InvalidOption("--time-limit: expected a number above 0");
  return {seconds, static_cast<std::size_t>(values.integer("memory-limit", 0)), kGraceSeconds};
}

MethodReport run_tool(const ToolRun& run, TriangleMesh& mesh, const ProgressCallback& progress) {
  const ProcessOutcome outcome = run_process(run.command, run.limits, "smoothing", progress, run.surroundings);
  if (const std::string why = why_failed(outcome, run.limits); !why.empty())
    throw MethodFailed(fmt::format("{}: {} {}", run.method, fs::path(run.command.front()).filename().string(), why));
  TriangleMesh result = read_result(run, outcome);

  MethodReport report;
  report.rounds_run = static_cast<std::size_t>(run.rounds);
  report.seconds.emplace_back("smoothing", Seconds{outcome.seconds, outcome.cpu_seconds});
  report.notes.emplace_back("the time is the tool's own process: it includes its start, its reading and its writing of files");
  DivergenceWatch watch(mesh.points);
  watch.look(result.points, 1);
  report.stopped_because = watch.first_bad_step() ? "diverged" : "done";
  if (watch.first_bad_step())
    report.notes.emplace_back("the result is far out of the bounds of the input; the tool does not say since which step");
  mesh = std::move(result);
  return report;
}

}  // namespace smopt::baselines
