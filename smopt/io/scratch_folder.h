#pragma once

#include <filesystem>
#include <string_view>

namespace smopt {

/// A new folder for temporary files, removed at the end of the scope.
class ScratchFolder {
 public:
  /// \param purpose  stands in the folder's name. \throws InvalidInput when the folder cannot be made.
  explicit ScratchFolder(std::string_view purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace smopt
