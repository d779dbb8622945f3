#pragma once

#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// Reads Wavefront OBJ (Alias|Wavefront, "Advanced Visualizer" appendix B1): the `v` and `f` statements, `f` with texture and normal
/// indices
/// (`1/2/3`, `1//3`) and with indices counted backwards (`-1`); its other statements are passed over, a word that is none is an error.
/// \param name  how messages call it.
/// \throws InvalidInput "name:line: what is wrong"; also for a file without vertices.
/// Cost: O(bytes).
TriangleMesh parse_obj(std::string_view text, const std::string& name);

/// The mesh as OBJ, ready to be written to a file.
std::string format_obj(const TriangleMesh& mesh, const MeshWriteOptions& options);

}  // namespace smopt
