#pragma once

#include <span>
#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// Reads the Polygon File Format (Turk, "The PLY polygon file format", 1994): text, or binary of either byte order.
///
/// Takes x, y, z of the element `vertex` and the list `vertex_indices` (or `vertex_index`) of the element `face`, of any number type; other
/// properties and elements are passed over. A file without faces is a mesh without triangles; one with triangle strips is refused.
/// \param name  how messages call it.
/// \throws InvalidInput "name:line: what is wrong" in the header and in text, "name: element: what is wrong" in a binary body.
/// Cost: O(bytes).
TriangleMesh parse_ply(std::string_view bytes, const std::string& name);

/// The mesh as binary little-endian PLY with coordinates in double precision; `options.digits` means nothing here.
std::string format_ply(const TriangleMesh& mesh, const MeshWriteOptions& options);

/// The same with these numbers as further `double` properties of the vertices; each has one value a vertex and a name without blanks.
std::string format_ply_with_scalars(const TriangleMesh& mesh, std::span<const VertexScalars> scalars);

}  // namespace smopt
