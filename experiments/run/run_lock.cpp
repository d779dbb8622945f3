#include "experiments/run/run_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "smopt/error.h"

namespace smopt::experiments {

RunLock::RunLock(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  const std::filesystem::path path = directory / ".lock";
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw InvalidInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  close(file_);
  throw InvalidInput(fmt::format("{}: another run is at work in this folder", directory.string()));
}

RunLock::~RunLock() {
  close(file_);
}

}  // namespace smopt::experiments
