#pragma once

#include <span>
#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// Reads VTK's PolyData in XML (VTK file formats, "XML file formats"), its arrays stored in any way that VTK writes them without asking for
/// more than zlib. Takes points and polygons; lines, single vertices and data fields are left, triangle strips refused. Pieces are joined.
/// \param name  how messages call it.
/// \throws InvalidInput "name:line: what is wrong".
/// Cost: O(bytes); one array at a time is unpacked.
TriangleMesh parse_vtp(std::string_view document, const std::string& name);

/// The mesh as VTK PolyData: base64 doubles, which lose nothing, or with `options.digits` a text of that many digits.
std::string format_vtp(const TriangleMesh& mesh, const MeshWriteOptions& options);

/// The same, base64, with these numbers as point data; each has one value a vertex, and a name that XML need not quote.
std::string format_vtp_with_scalars(const TriangleMesh& mesh, std::span<const VertexScalars> scalars);

}  // namespace smopt
