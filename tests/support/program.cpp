#include "tests/support/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace smopt::testing {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Between two looks at whether the program has ended.
constexpr std::chrono::milliseconds kPatience{2};

void require(bool is_done, const char* what) {
  if (!is_done) throw std::runtime_error(what);
}

/// The three standard streams of a program to be started.
class Streams {
 public:
  Streams() { posix_spawn_file_actions_init(&actions_); }
  ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;

  void from_file(const fs::path& path) { posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, path.c_str(), O_RDONLY, 0); }
  void from_descriptor(int fd) { posix_spawn_file_actions_adddup2(&actions_, fd, STDIN_FILENO); }
  void to_file(int fd, const fs::path& path) {
    posix_spawn_file_actions_addopen(&actions_, fd, path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

pid_t spawn(const fs::path& program, const std::vector<std::string>& arguments, const Streams& streams) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  std::transform(words.begin(), words.end(), std::back_inserter(argv), [](std::string& word) { return word.data(); });
  argv.push_back(nullptr);
  pid_t pid = -1;
  require(posix_spawn(&pid, program.c_str(), streams.get(), nullptr, argv.data(), environ) == 0, "cannot start the program");
  return pid;
}

}  // namespace

RunningProgram::RunningProgram(const fs::path& program, const std::vector<std::string>& arguments, const std::string& input, Input kind) {
  Streams streams;
  int ends[2] = {-1, -1};
  if (kind == Input::open_pipe) {
    require(pipe2(ends, O_CLOEXEC) == 0, "cannot make a pipe");
    streams.from_descriptor(ends[0]);
  } else {
    streams.from_file(folder_.file("in", input));
  }
  streams.to_file(STDOUT_FILENO, folder_.path() / "out");
  streams.to_file(STDERR_FILENO, folder_.path() / "err");
  pid_ = spawn(program, arguments, streams);
  if (kind == Input::open_pipe) close(ends[0]);
  pipe_ = ends[1];
}

RunningProgram::~RunningProgram() {
  if (is_running()) {
    send(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (pipe_ >= 0) close(pipe_);
}

void RunningProgram::send(int signal) const {
  if (!status_) kill(pid_, signal);
}

bool RunningProgram::is_running() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  return !status_;
}

double RunningProgram::cpu_seconds() const {
  // Fields 14 and 15 of /proc/PID/stat, counted from the end of the program's name, which is the second and stands in parentheses.
  constexpr int kFieldsBefore = 11;
  std::string text = bytes_of(fmt::format("/proc/{}/stat", pid_));
  std::istringstream stat(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string skipped;
  for (int i = 0; i < kFieldsBefore; ++i) stat >> skipped;
  double user = 0;
  double system = 0;
  stat >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

ProgramResult RunningProgram::wait(std::chrono::milliseconds time_limit) {
  ProgramResult result;
  const Clock::time_point end = Clock::now() + time_limit;
  while (is_running()) {
    if (Clock::now() > end && !result.is_out_of_time) {
      result.is_out_of_time = true;
      send(SIGKILL);
    }
    std::this_thread::sleep_for(kPatience);
  }
  if (WIFEXITED(*status_)) result.exit_code = WEXITSTATUS(*status_);
  if (WIFSIGNALED(*status_)) result.signal = WTERMSIG(*status_);
  result.out = bytes_of(folder_.path() / "out");
  result.err = bytes_of(folder_.path() / "err");
  return result;
}

ProgramResult run_program(const fs::path& program, const std::vector<std::string>& arguments, const std::string& input) {
  return RunningProgram(program, arguments, input).wait();
}

}  // namespace smopt::testing
