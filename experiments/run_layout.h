#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

/// Where the files of a run are.
namespace smopt::experiments {

/// `directory`/records/<molecule>/<method>.json
std::filesystem::path record_path(const std::filesystem::path& directory, std::string_view molecule, std::string_view method);

/// The mesh of a case, where the run still has it: as the case left it in `directory`/steps/<molecule>/<method>.ply, or as kept for the user in
/// `directory`/meshes/<molecule>/<method>.off. `method` may also be "initial" or "without-cavities" (what the methods were given).
std::optional<std::filesystem::path> find_mesh(const std::filesystem::path& directory, std::string_view molecule, std::string_view method);

}  // namespace smopt::experiments
