#pragma once

#include <string>

#include "metrics/tetgen/tet_mesh.h"

namespace smopt::metrics {

/// The text of a VTK XML unstructured grid (version 1.0, arrays as base64 with 64-bit headers, little-endian): points as doubles.
std::string to_vtu(const TetMesh& mesh);

}  // namespace smopt::metrics
