#pragma once

#include <filesystem>

#include "metrics/tetgen/tet_mesh.h"

namespace smopt::metrics {

/// Writes a tetrahedral mesh; the format follows from the name's ending: .vtu (VTK), .msh (Gmsh 4.1), .node or .ele (TetGen's: both of
/// them, and .face with the boundary). Each file is written beside its name and renamed. \throws InvalidInput when the ending is unknown or
/// a file cannot be written.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);

/// Whether the name's ending is one of these.
bool is_tet_mesh_format(const std::filesystem::path& path);

}  // namespace smopt::metrics
