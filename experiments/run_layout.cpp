#include "experiments/run_layout.h"

#include <string>

namespace smopt::experiments {

namespace fs = std::filesystem;

fs::path record_path(const fs::path& directory, std::string_view molecule, std::string_view method) {
  return directory / "records" / molecule / (std::string(method) + ".json");
}

std::optional<fs::path> find_mesh(const fs::path& directory, std::string_view molecule, std::string_view method) {
  for (const auto& [folder, ending] : {std::pair("steps", ".ply"), std::pair("meshes", ".off")}) {
    fs::path path = directory / folder / molecule / (std::string(method) + ending);
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path;
  }
  return std::nullopt;
}

}  // namespace smopt::experiments
