#include "smopt/io/child_process.h"

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

namespace smopt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMs = 50;                                ///< between two looks at the clock; short enough to answer Ctrl-C at once
constexpr std::chrono::milliseconds kPatience{5};          ///< between two looks at what has been asked to end
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

/// \throws InvalidInput with the system's word for the last error.
void require_started(bool is_well, const std::vector<std::string>& command) {
  if (!is_well) throw InvalidInput(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
}

void set_limit(int resource, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// Texts as the system wants them: pointers, a null at the end. \pre the texts outlive the result.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// This process's variables, those that are set anew left out, and the new ones.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables) {
  std::vector<std::string> result;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (!variables.contains(std::string(text.substr(0, text.find('='))))) result.emplace_back(text);
  }
  for (const auto& [name, value] : variables) result.push_back(name + "=" + value);
  return result;
}

/// What the child needs, laid out before the fork.
struct Start {
  Start(const std::vector<std::string>& command, const ProcessSurroundings& surroundings)
      : words(command), variables(environment_with(surroundings.environment)), folder(surroundings.folder.string()) {}

  std::vector<std::string> words, variables;
  std::vector<char*> argv = pointers_to(words), envp = pointers_to(variables);
  std::string folder;
};

/// In the child, between fork and exec: calls that are safe there only.
[[noreturn]] void become(const Start& start, const ProcessLimits& limits, int output, int held, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotStart);
  set_limit(RLIMIT_CORE, 0);
  if (limits.memory_mb > 0 && !kAddressSanitizer) set_limit(RLIMIT_AS, static_cast<rlim_t>(limits.memory_mb) << 20U);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  fcntl(held, F_SETFD, 0);  // goes on to the program and to whatever it starts
  if (!start.folder.empty() && chdir(start.folder.c_str()) != 0) _exit(kCannotStart);
  execve(start.argv[0], start.argv.data(), start.envp.data());
  _exit(kCannotStart);
}

/// A running child: its output is collected, and it does not outlive this object.
class Child {
 public:
  Child(const std::vector<std::string>& command, const ProcessLimits& limits, const ProcessSurroundings& surroundings)
      : grace_seconds_(limits.grace_seconds) {
    const Start start(command, surroundings);
    std::array<int, 2> ends{}, until_started{}, until_ended{};
    require_started(pipe2(ends.data(), O_CLOEXEC) == 0, command);
    output_.reset(ends[0]);
    const Descriptor input(ends[1]);
    require_started(pipe2(until_started.data(), O_CLOEXEC) == 0, command);
    const Descriptor started(until_started[0]);
    Descriptor not_started(until_started[1]);
    require_started(pipe2(until_ended.data(), O_CLOEXEC) == 0, command);
    lifeline_.reset(until_ended[0]);
    const Descriptor held(until_ended[1]);
    const pid_t parent = getpid();
    pid_ = fork();
    require_started(pid_ >= 0, command);
    if (pid_ == 0) become(start, limits, input.get(), held.get(), parent);
    setpgid(pid_, pid_);  // in both, so that it is done before either goes on
    // The child's end closes as it becomes the program: before that, its memory is a copy of this process's.
    not_started.reset();
    char nothing = 0;
    while (read(started.get(), &nothing, 1) < 0 && errno == EINTR) {
    }
  }
  ~Child() {
    if (pid_ > 0 && !ended_) stop();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits a moment for output or the end; true when it has ended.
  bool step() {
    look_at_memory();
    collect_output(kPollMs);
    look_at_memory();
    ended_ = reap(WNOHANG);
    if (ended_) stop();
    return ended_;
  }
  /// Ends what is still there of it and of what it started.
  void stop() {
    ask_all_to_end();
    kill(-pid_, SIGKILL);
    if (!ended_) ended_ = reap(0);
    collect_output(0);
  }

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }
  [[nodiscard]] double peak_memory_mb() const { return peak_memory_mb_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void look_at_memory() { peak_memory_mb_ = std::max(peak_memory_mb_, peak_memory_mb_of(std::to_string(pid_))); }

  bool reap(int flags) {
    rusage used{};
    if (wait4(pid_, &status_, flags, &used) != pid_) return false;
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    cpu_seconds_ = seconds(used.ru_utime) + seconds(used.ru_stime);
    return true;
  }

  /// Whether something of the process group still runs: what has ended and was not waited for holds no descriptor.
  [[nodiscard]] bool is_something_left() const {
    pollfd lifeline{lifeline_.get(), POLLIN, 0};
    return kill(-pid_, 0) == 0 && poll(&lifeline, 1, 0) == 0;
  }

  void ask_all_to_end() {
    if (grace_seconds_ <= 0 || kill(-pid_, SIGTERM) != 0) return;
    const auto end = Clock::now() + std::chrono::duration<double>(grace_seconds_);
    while (is_something_left() && Clock::now() < end) {
      std::this_thread::sleep_for(kPatience);
    }
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
  double grace_seconds_;
  double cpu_seconds_ = 0;
  double peak_memory_mb_ = 0;
  Descriptor output_;
  Descriptor lifeline_;  ///< at its end once nobody holds the other end any more
  std::string text_;
};

}  // namespace

ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits, const char* stage,
                           const ProgressCallback& progress, const ProcessSurroundings& surroundings) {
  require_started(access(command.front().c_str(), X_OK) == 0, command);
  ProcessOutcome outcome;
  const auto start = Clock::now();
  const auto elapsed = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Child child(command, limits, surroundings);
  while (!child.step()) {
    report_progress(progress, stage, std::min(elapsed() / limits.seconds, 1.0));
    if (elapsed() < limits.seconds) continue;
    outcome.out_of_time = true;
    child.stop();
    break;
  }
  outcome.seconds = elapsed();
  outcome.cpu_seconds = child.cpu_seconds();
  outcome.peak_memory_mb = child.peak_memory_mb();
  outcome.output = child.text();
  if (WIFSIGNALED(child.status())) outcome.signal = WTERMSIG(child.status());
  if (WIFEXITED(child.status())) outcome.exit_status = WEXITSTATUS(child.status());
  return outcome;
}

}  // namespace smopt
