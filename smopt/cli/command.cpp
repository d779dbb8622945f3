#include "smopt/cli/command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "smopt/error.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {

void require_writable_mesh(const std::string& file) {
  if (!is_writable_mesh_format(file))
    throw InvalidOption(fmt::format("{}: not a mesh format that can be written ({})", file, mesh_format_names()));
}

void require_writable_place(const std::string& file) {
  namespace fs = std::filesystem;
  if (file == "-") return;
  std::error_code ignored;
  const bool is_there = fs::exists(file, ignored);
  const fs::path folder = fs::path(file).parent_path();
  const std::string written = is_there ? file : folder.empty() ? "." : folder.string();
  if (is_there && fs::is_directory(file, ignored)) throw InvalidInput(fmt::format("{}: {}", file, std::strerror(EISDIR)));
  if (::access(written.c_str(), W_OK) != 0) throw InvalidInput(fmt::format("{}: {}", file, std::strerror(errno)));
}

}  // namespace smopt::cli
