#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace smopt::testing {

/// A folder of this test's own that is removed at the end of its scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes `content` to a file in the folder and returns its path.
  [[nodiscard]] std::filesystem::path file(std::string_view name, std::string_view content) const;

 private:
  std::filesystem::path path_;
};

/// The bytes of a file; empty when it does not exist.
std::string bytes_of(const std::filesystem::path& path);

/// A molecule of Debian's apbs-data ("misc/mache.pqr"), or an empty path where the package is not installed.
std::filesystem::path apbs_molecule(std::string_view name);

/// One of the large molecules that lie beside the project on some machines (`../shared/data/molecules`), or an empty path.
std::filesystem::path shared_molecule(std::string_view name);

}  // namespace smopt::testing
