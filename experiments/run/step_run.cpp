#include "experiments/run/step_run.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "experiments/machine.h"
#include "metrics/tetgen/worker_location.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "smopt/io/file.h"
#include "smopt/io/sha256.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kDone = "done";
constexpr const char* kFailed = "failed";
constexpr const char* kNotInstalledStatus = "not installed";

/// What is run: the number of threads is no part of the command, as no result depends on it.
std::vector<std::string> command_line(const Step& step, const StepPlace& place) {
  std::vector<std::string> command = step.command;
  if (command.front() == kThisProgram) command.front() = place.program.string();
  if (step.needs.threads == kAllThreads && place.threads > 0)
    command.insert(command.end(), {"--threads", fmt::format("{}", place.threads)});
  return command;
}

fs::path in_run(const fs::path& directory, const std::string& file) {
  return directory / file;  // an absolute one stays as it is
}

/// Why the step cannot be tried: the reason of the first predecessor that did not end well.
std::optional<StepOutcome> hindrance(const Step& step, const fs::path& directory) {
  for (const std::string& id : step.after) {
    Step before;
    before.id = id;
    const auto stamp = read_stamp(before, directory);
    if (!stamp) return StepOutcome{kFailed, fmt::format("{} has not been run", id)};
    if (stamp->at("status") != kDone) return StepOutcome{stamp->at("status").get<std::string>(), stamp->at("reason").get<std::string>()};
  }
  return std::nullopt;
}

/// The last line of what a program printed, which is where it says what was wrong.
std::string last_line(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t end = text.find_last_not_of(kSpace);
  if (end == std::string_view::npos) return "";
  text = text.substr(0, end + 1);
  const std::size_t line = text.find_last_of('\n');
  return std::string(line == std::string_view::npos ? text : text.substr(line + 1));
}

/// Without the name with which this program begins its messages.
std::string message_of(const ProcessOutcome& ended) {
  std::string line = last_line(ended.output);
  constexpr std::string_view kPrefix = "smopt: ";
  return line.starts_with(kPrefix) ? line.substr(kPrefix.size()) : line;
}

bool are_outputs_there(const Step& step, const fs::path& directory) {
  std::error_code ignored;
  return std::ranges::all_of(step.outputs, [&](const std::string& file) { return fs::exists(in_run(directory, file), ignored); });
}

std::string failure_of(const Step& step, const ProcessOutcome& ended) {
  if (ended.out_of_time) return fmt::format("not finished after {:.0f} s", step.limits.seconds);
  if (ended.signal) return fmt::format("crashed (signal {}: {})", *ended.signal, strsignal(*ended.signal));
  const std::string message = message_of(ended);
  if (message == "out of memory") return fmt::format("out of memory: more than {} MB", step.limits.memory_mb);
  return message.empty() ? fmt::format("exit status {}", ended.exit_status.value_or(-1)) : message;
}

StepOutcome judge(const Step& step, const ProcessOutcome& ended, const fs::path& directory) {
  const bool ended_well = ended.exit_status == 0 || (step.may_say_no && ended.exit_status == 1);
  if (ended_well && are_outputs_there(step, directory)) return {kDone, ""};
  const std::string failure = failure_of(step, ended);
  if (failure.starts_with(kNotInstalledPrefix)) return {kNotInstalledStatus, failure.substr(std::strlen(kNotInstalledPrefix))};
  return {kFailed, failure};
}

/// Whether somebody asked it to end, such as a batch system that stops the whole run: that says nothing of the step.
bool was_interrupted(const ProcessOutcome& ended) {
  constexpr int kOfAShell = 128;  // and the signal, whose command was ended by it; this program says it as 130 as well
  return std::ranges::any_of(std::array{SIGTERM, SIGINT},
                             [&](int signal) { return ended.signal == signal || ended.exit_status == kOfAShell + signal; });
}

Json digests_of(const Step& step, const fs::path& directory) {
  Json digests = Json::object();
  for (const std::string& file : step.outputs) digests[file] = sha256_of_file(in_run(directory, file));
  return digests;
}

Json process_json(const ProcessOutcome& ended) {
  return {{"exit_status", ended.exit_status ? Json(*ended.exit_status) : Json()},
          {"signal", ended.signal ? Json(*ended.signal) : Json()},
          {"out_of_time", ended.out_of_time},
          {"seconds", ended.seconds},
          {"cpu_seconds", ended.cpu_seconds},
          {"peak_memory_mb", ended.peak_memory_mb}};
}

/// Messages of other programs need not be UTF-8.
void write_stamp(const Step& step, const fs::path& directory, const Json& stamp) {
  write_file(in_run(directory, stamp_path(step)), stamp.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json stamp_of(const Step& step, const StepOutcome& outcome) {
  return {{"status", outcome.status}, {"reason", outcome.reason}, {"command", step.command}};
}

/// What an earlier attempt left: a stamp that no longer holds, outputs that would be taken for new ones.
void clear(const Step& step, const fs::path& directory) {
  std::error_code ignored;
  const fs::path stamp = in_run(directory, stamp_path(step));
  fs::remove(stamp, ignored);
  fs::create_directories(stamp.parent_path(), ignored);
  for (const std::string& file : step.outputs) {
    fs::remove(in_run(directory, file), ignored);
    fs::create_directories(in_run(directory, file).parent_path(), ignored);
  }
}

StepOutcome run_command(const Step& step, const StepPlace& place, const ProgressCallback& progress) {
  const std::string key = step_key(step, place);
  ProcessLimits limits;
  limits.seconds = step.limits.seconds;
  limits.memory_mb = step.limits.memory_mb;
  ProcessSurroundings surroundings;
  surroundings.folder = place.directory;
  const ProcessOutcome ended = run_process(command_line(step, place), limits, step.rule.c_str(), progress, surroundings);
  StepOutcome outcome = judge(step, ended, place.directory);
  Json stamp = stamp_of(step, outcome);
  outcome.is_interrupted = was_interrupted(ended);
  if (!outcome.is_interrupted) stamp["key"] = key;  // without it, it is done again
  if (step.needs.threads == kAllThreads) stamp["threads"] = place.threads;
  stamp["sha256"] = outcome.status == kDone ? digests_of(step, place.directory) : Json::object();
  stamp["version"] = version();
  stamp["program_sha256"] = place.program_sha256;
  stamp["machine"] = machine_json();
  stamp.update(process_json(ended));
  write_stamp(step, place.directory, stamp);
  return outcome;
}

/// Whether more threads might have been done in time.
bool ran_out_of_time_otherwise(const Step& step, const Json& stamp, const StepPlace& place) {
  return step.needs.threads == kAllThreads && stamp.value("out_of_time", false) && stamp.value("threads", 0) != place.threads;
}

bool are_as_left(const Step& step, const Json& stamp, const fs::path& directory) {
  if (stamp.at("status") != kDone) return true;
  return are_outputs_there(step, directory) && digests_of(step, directory) == stamp.at("sha256");
}

/// Of the worker beside the program that runs this: its steps find the same.
std::string tetgen_digest() {
  try {
    return sha256_of_file(metrics::find_tetgen_worker());
  } catch (const InvalidInput&) {
    return "";  // whoever needs it says that it is missing
  }
}

}  // namespace

StepPlace step_place(const fs::path& directory, const fs::path& program) {
  StepPlace place;
  place.directory = fs::absolute(directory);
  // This very program, even when a new one is built in its place meanwhile.
  place.program = program.empty() ? fs::path(fmt::format("/proc/{}/exe", getpid())) : fs::absolute(program);
  place.program_sha256 = sha256_of_file(place.program);
  place.tetgen_sha256 = tetgen_digest();
  return place;
}

std::string step_key(const Step& step, const StepPlace& place) {
  Json made_from = {{"program", step.command.front() == kThisProgram ? place.program_sha256 : ""},
                    {"command", step.command},
                    {"inputs", Json::array()},
                    {"seconds", step.limits.seconds},
                    {"memory_mb", step.limits.memory_mb}};
  for (const std::string& file : step.inputs) made_from["inputs"].push_back(sha256_of_file(in_run(place.directory, file)));
  if (step.rule == "tetrahedralize") made_from["tetgen"] = place.tetgen_sha256;
  return sha256_hex(made_from.dump());
}

StepOutcome run_step(const Step& step, const StepPlace& place, const ProgressCallback& progress) {
  clear(step, place.directory);
  std::optional<StepOutcome> hindered = hindrance(step, place.directory);
  if (!hindered) {
    try {
      return run_command(step, place, progress);
    } catch (const InvalidInput& error) {  // an input is missing, or the program
      hindered = StepOutcome{kFailed, step.hint.empty() ? error.what() : fmt::format("{}; {}", error.what(), step.hint)};
    }
  }
  write_stamp(step, place.directory, stamp_of(step, *hindered));
  return *hindered;
}

std::optional<StepOutcome> earlier_outcome(const Step& step, const StepPlace& place) {
  try {
    const auto stamp = read_stamp(step, place.directory);
    if (!stamp || !stamp->contains("key") || stamp->at("status") == kNotInstalledStatus) return std::nullopt;
    if (hindrance(step, place.directory) || stamp->at("key") != step_key(step, place) || !are_as_left(step, *stamp, place.directory) ||
        ran_out_of_time_otherwise(step, *stamp, place))
      return std::nullopt;
    return StepOutcome{stamp->at("status").get<std::string>(), stamp->at("reason").get<std::string>(), true};
  } catch (const InvalidInput&) {
    return std::nullopt;  // a file has gone
  } catch (const Json::exception&) {
    return std::nullopt;  // no stamp of ours
  }
}

std::optional<Json> read_stamp(const Step& step, const fs::path& directory) {
  const fs::path file = in_run(directory, stamp_path(step));
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  Json stamp = Json::parse(read_file(file), nullptr, false);
  if (!stamp.is_object() || !stamp.contains("status") || !stamp.contains("reason")) return std::nullopt;
  return stamp;
}

}  // namespace smopt::experiments
