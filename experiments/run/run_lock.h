#pragma once

#include <filesystem>

namespace smopt::experiments {

/// Keeps a second run out of a run's folder, for as long as this exists; whoever is killed leaves no lock behind.
class RunLock {
 public:
  /// Makes the folder where there is none. \throws InvalidInput when it cannot be made, or another run is at work there.
  explicit RunLock(const std::filesystem::path& directory);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace smopt::experiments
