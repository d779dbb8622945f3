#pragma once

#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// Reads Geomview's Object File Format (geomview.org/docs/html/OFF.html) in its text form, one vertex or face a line, with comments.
///
/// The keyword is required; C, N and ST before it, and whatever follows the coordinates or the indices of a line (normals, colours), are
/// accepted and left. Vertices without a triangle are kept.
/// \param name  how messages call it.
/// \throws InvalidInput "name:line: what is wrong".
/// Cost: O(bytes); the text and the mesh are in memory, nothing else.
TriangleMesh parse_off(std::string_view text, const std::string& name);

/// The mesh as OFF, ready to be written to a file.
std::string format_off(const TriangleMesh& mesh, const MeshWriteOptions& options);

}  // namespace smopt
