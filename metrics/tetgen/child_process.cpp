#include "metrics/tetgen/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <thread>

#include "smopt/peak_memory.h"

namespace smopt::metrics {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMs = 50;                                ///< between two looks at the clock; short enough to answer Ctrl-C at once
constexpr std::size_t kKeptOutput = std::size_t{1} << 20;  ///< bytes; TetGen's messages are a few kilobytes
constexpr int kCannotStart = 127;                          ///< exit status of a child that could not become the program, as in shells

#ifdef __SANITIZE_ADDRESS__
constexpr bool kAddressSanitizer = true;
#else
constexpr bool kAddressSanitizer = false;
#endif

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void reset(int fd = -1) {
    if (fd_ >= 0) close(fd_);
    fd_ = fd;
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

void set_limit(int resource, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// In the child, between fork and exec: calls that are safe there only.
[[noreturn]] void become(char* const* argv, const ProcessLimits& limits, int output, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotStart);
  set_limit(RLIMIT_CORE, 0);
  if (limits.memory_mb > 0 && !kAddressSanitizer) set_limit(RLIMIT_AS, static_cast<rlim_t>(limits.memory_mb) << 20U);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(kCannotStart);
}

/// A running child: its output is collected, and it does not outlive this object.
class Child {
 public:
  Child(const std::vector<std::string>& command, const ProcessLimits& limits) {
    std::vector<char*> argv;
    for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    std::array<int, 2> ends{}, until_started{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw InvalidInput(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
    output_.reset(ends[0]);
    const Descriptor input(ends[1]);
    if (pipe2(until_started.data(), O_CLOEXEC) != 0)
      throw InvalidInput(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
    const Descriptor started(until_started[0]);
    Descriptor not_started(until_started[1]);
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0) throw InvalidInput(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
    if (pid_ == 0) become(argv.data(), limits, input.get(), parent);
    setpgid(pid_, pid_);  // in both, so that it is done before either goes on
    // The child's end closes as it becomes the program: before that, its memory is a copy of this process's.
    not_started.reset();
    char nothing = 0;
    while (read(started.get(), &nothing, 1) < 0 && errno == EINTR) {
    }
  }
  ~Child() {
    if (ended_) return;
    kill_all();
    waitpid(pid_, &status_, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits a moment for output or the end; true when it has ended.
  bool step() {
    look_at_memory();
    collect_output(kPollMs);
    look_at_memory();
    if (waitpid(pid_, &status_, WNOHANG) == pid_) end();
    return ended_;
  }
  void stop() {
    kill_all();
    if (waitpid(pid_, &status_, 0) == pid_) end();
  }

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] double peak_memory_mb() const { return peak_memory_mb_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void look_at_memory() { peak_memory_mb_ = std::max(peak_memory_mb_, peak_memory_mb_of(std::to_string(pid_))); }

  void kill_all() const { kill(-pid_, SIGKILL); }

  void end() {
    ended_ = true;
    kill_all();  // what it started and left behind
    collect_output(0);
  }

  void collect_output(int wait_ms) {
    pollfd ready{output_.get(), POLLIN, 0};
    if (output_.get() < 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
      return;
    }
    std::array<char, 1U << 16U> buffer{};
    while (poll(&ready, 1, wait_ms) > 0) {
      const ssize_t n = read(output_.get(), buffer.data(), buffer.size());
      if (n <= 0) {
        output_.reset();
        return;
      }
      keep(std::string_view(buffer.data(), static_cast<std::size_t>(n)));
      wait_ms = 0;
      if (!ended_) return;
    }
  }

  void keep(std::string_view more) {
    text_ += more;
    if (text_.size() > 2 * kKeptOutput) text_.erase(0, text_.size() - kKeptOutput);
  }

  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
  double peak_memory_mb_ = 0;
  Descriptor output_;
  std::string text_;
};

}  // namespace

ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits, const char* stage,
                           const ProgressCallback& progress) {
  if (access(command.front().c_str(), X_OK) != 0)
    throw InvalidInput(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
  ProcessOutcome outcome;
  const auto start = Clock::now();
  const auto elapsed = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Child child(command, limits);
  while (!child.step()) {
    report_progress(progress, stage, std::min(elapsed() / limits.seconds, 1.0));
    if (elapsed() < limits.seconds) continue;
    outcome.out_of_time = true;
    child.stop();
    break;
  }
  outcome.seconds = elapsed();
  outcome.peak_memory_mb = child.peak_memory_mb();
  outcome.output = child.text();
  if (WIFSIGNALED(child.status())) outcome.signal = WTERMSIG(child.status());
  if (WIFEXITED(child.status())) outcome.exit_status = WEXITSTATUS(child.status());
  return outcome;
}

}  // namespace smopt::metrics
