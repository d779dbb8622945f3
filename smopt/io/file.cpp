#include "smopt/io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "smopt/error.h"
#include "smopt/io/gzip.h"

namespace smopt {
namespace {

namespace fs = std::filesystem;

/// First buffer for what has no size of its own (pipes); it doubles from there.
constexpr std::size_t kFirstBuffer = std::size_t{1} << 16;
/// Names tried for the file beside the target before giving up: one that is taken is left over from a process that was killed.
constexpr int kNameAttempts = 100;

[[noreturn]] void throw_system_error(const std::string& name, int error) {
  throw InvalidInput(fmt::format("{}: {}", name, std::strerror(error)));
}

bool is_standard_stream(const fs::path& path) {
  return path == "-";
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int get() const { return fd_; }
  /// Closes now; false with errno set when what was written did not arrive.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

std::size_t size_on_disk(int fd) {
  struct stat info {};
  return ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) : kFirstBuffer;
}

std::string read_all(int fd, const std::string& name) {
  std::string content(size_on_disk(fd) + 1, '\0');  // one byte more: the end of the file is met without growing
  std::size_t used = 0;
  while (true) {
    const ssize_t n = ::read(fd, content.data() + used, content.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw_system_error(name, errno);
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used == content.size()) content.resize(2 * content.size());
  }
  content.resize(used);
  return content;
}

void write_all(int fd, std::string_view content, const std::string& name) {
  while (!content.empty()) {
    const ssize_t n = ::write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw_system_error(name, errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// A device, a pipe or a socket: written to as it is, never replaced by a file.
bool is_special(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_special(const fs::path& path, std::string_view content) {
  const Descriptor out(is_standard_stream(path) ? STDOUT_FILENO : ::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  const std::string name = is_standard_stream(path) ? "standard output" : path.string();
  if (out.get() < 0) throw_system_error(name, errno);
  write_all(out.get(), content, name);
}

/// The new content of a file, beside it until `commit` renames it; removed if that never comes.
class PendingFile {
 public:
  explicit PendingFile(const fs::path& path) : name_(path.string()), target_(fs::is_symlink(path) ? fs::weakly_canonical(path) : path) {
    if (fs::is_directory(target_)) throw_system_error(name_, EISDIR);
  }
  ~PendingFile() {
    if (!beside_.empty()) ::unlink(beside_.c_str());
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(std::string_view content) {
    Descriptor out(create_beside());
    keep_permissions(out.get());
    write_all(out.get(), content, name_);
    if (!out.close()) throw_system_error(name_, errno);
  }

  void commit() {
    if (::rename(beside_.c_str(), target_.c_str()) != 0) throw_system_error(name_, errno);
    beside_.clear();
  }

 private:
  int create_beside() {
    static std::atomic<unsigned> serial = 0;
    for (int attempt = 0; attempt < kNameAttempts; ++attempt) {
      const std::string candidate = fmt::format("{}.{}-{}.tmp", target_.string(), ::getpid(), serial++);
      const int fd = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (fd < 0 && errno == EEXIST) continue;
      if (fd < 0) break;
      beside_ = candidate;
      return fd;
    }
    throw_system_error(name_, errno);
  }

  /// A file that is replaced keeps its permissions.
  void keep_permissions(int fd) const {
    struct stat info {};
    if (::stat(target_.c_str(), &info) == 0 && ::fchmod(fd, info.st_mode & 07777) != 0) throw_system_error(name_, errno);
  }

  std::string name_;
  fs::path target_;
  std::string beside_;
};

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

void write_plain_files(std::span<const FileContent> files) {
  std::vector<std::unique_ptr<PendingFile>> pending;
  for (const FileContent& file : files) {
    if (is_standard_stream(file.path) || is_special(file.path)) {
      write_special(file.path, file.content);
    } else {
      pending.push_back(std::make_unique<PendingFile>(file.path));
      pending.back()->write(file.content);
    }
  }
  for (const auto& file : pending) file->commit();
}

}  // namespace

bool is_gzip_name(const fs::path& path) {
  return lower_case(path.extension().string()) == ".gz";
}

std::string display_name(const fs::path& path) {
  return is_standard_stream(path) ? "standard input" : path.string();
}

std::string read_file(const fs::path& path) {
  const std::string name = display_name(path);
  const Descriptor in(is_standard_stream(path) ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (in.get() < 0) throw_system_error(name, errno);
  std::string content = read_all(in.get(), name);
  return is_gzip(content) ? gunzip(content, name) : content;
}

void write_files(std::span<const FileContent> files) {
  std::vector<std::string> packed(files.size());
  std::vector<FileContent> plain(files.begin(), files.end());
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!is_gzip_name(files[i].path)) continue;
    packed[i] = gzip(files[i].content);
    plain[i].content = packed[i];
  }
  try {
    write_plain_files(plain);
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(error.what());
  }
}

void write_file(const fs::path& path, std::string_view content) {
  const FileContent file{path, content};
  write_files({&file, 1});
}

std::string format_ending(const fs::path& path) {
  if (is_standard_stream(path)) return "off";
  const std::string ending = lower_case((is_gzip_name(path) ? path.stem() : path.filename()).extension().string());
  return ending.empty() ? ending : ending.substr(1);
}

}  // namespace smopt
