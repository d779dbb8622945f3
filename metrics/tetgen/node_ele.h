#pragma once

#include <string>

#include "metrics/tetgen/tet_mesh.h"

namespace smopt::metrics {

/// The texts of TetGen's own files, numbered from 0: points, tetrahedra, and boundary faces, whose markers are the number
/// of the surface's triangle plus 1.
std::string to_node(const TetMesh& mesh);
std::string to_ele(const TetMesh& mesh);
std::string to_face(const TetMesh& mesh);

}  // namespace smopt::metrics
