#pragma once

#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// Reads STL (3D Systems, "StereoLithography interface specification", 1988), text or binary, told apart by the size that the binary header
/// promises. Corners at exactly equal positions become one vertex, numbered in the order in which they come; all solids of a text are one
/// mesh. \param name  how messages call it. \throws InvalidInput "name:line: what is wrong" for text, "name: what is wrong" for binary.
/// Cost: O(triangles), with a hash table of the vertices.
TriangleMesh parse_stl(std::string_view bytes, const std::string& name);

/// The mesh as binary STL. The format is poorer than the mesh: coordinates are rounded to float32, vertices are repeated for each triangle,
/// and those without a triangle are lost; `options.digits` means nothing here. \throws InvalidInput for a coordinate that is finite and too
/// large for a float32.
std::string format_stl(const TriangleMesh& mesh, const MeshWriteOptions& options);

}  // namespace smopt
