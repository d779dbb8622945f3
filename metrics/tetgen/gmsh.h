#pragma once

#include <string>

#include "metrics/tetgen/tet_mesh.h"

namespace smopt::metrics {

/// The text of a Gmsh 4.1 ASCII file: one volume (tag 1) with the tetrahedra and one surface (tag 1)
/// with the boundary faces. Node and element tags count from 1.
std::string to_gmsh(const TetMesh& mesh);

}  // namespace smopt::metrics
