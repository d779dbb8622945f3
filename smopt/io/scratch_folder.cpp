#include "smopt/io/scratch_folder.h"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

#include "smopt/error.h"

namespace smopt {

ScratchFolder::ScratchFolder(std::string_view purpose) {
  std::string name = (std::filesystem::temp_directory_path() / fmt::format("smopt-{}-XXXXXX", purpose)).string();
  if (mkdtemp(name.data()) == nullptr) throw InvalidInput(fmt::format("cannot make the temporary folder {}", name));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;  // a folder that stays behind is no reason to end
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace smopt
