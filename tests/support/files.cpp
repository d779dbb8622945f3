#include "tests/support/files.h"

#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace smopt::testing {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "smopt-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::file(std::string_view name, std::string_view content) const {
  const std::filesystem::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

std::filesystem::path apbs_molecule(std::string_view name) {
  const std::filesystem::path file = std::filesystem::path("/usr/share/apbs/examples") / name;
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

std::filesystem::path shared_molecule(std::string_view name) {
  const std::filesystem::path file = std::filesystem::path(SMOPT_SOURCE_FOLDER).parent_path() / "shared/data/molecules" / name;
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

}  // namespace smopt::testing
