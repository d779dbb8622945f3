#include "smopt/cli/command.h"

#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {

void require_writable_mesh(const std::string& file) {
  if (!is_writable_mesh_format(file))
    throw InvalidOption(fmt::format("{}: not a mesh format that can be written ({})", file, mesh_format_names()));
}

}  // namespace smopt::cli
