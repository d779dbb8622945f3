#pragma once

#include <string>
#include <string_view>

#include "smopt/io/mesh_io.h"

namespace smopt {

/// A mesh as the two files that MSMS (Sanner et al. 1996) writes: `.vert` and `.face`.
struct MsmsText {
  std::string vert;
  std::string face;
};

/// Reads a pair of MSMS files: after comments, a line that begins with the count, then a line for each vertex (x y z and whatever follows)
/// or face (three indices from 1 and whatever follows). \param vert_name, face_name  how messages call the two. \throws InvalidInput
/// "name:line: what is wrong". Cost: O(bytes).
TriangleMesh parse_msms(std::string_view vert, const std::string& vert_name, std::string_view face, const std::string& face_name);

/// The mesh as a pair of MSMS files. Normals are area-weighted (zero where there is none); the columns that name spheres and patches, of
/// which a mesh knows nothing, hold 0, 0, 2 for a vertex and 3, 0 for a face: on a contact patch of no particular sphere.
MsmsText format_msms(const TriangleMesh& mesh, const MeshWriteOptions& options);

/// Reads `path` (.vert or .face, each with or without .gz) and the other of the pair beside it.
/// \throws InvalidInput as `parse_msms`, and where one of the two is missing.
TriangleMesh read_msms(const std::filesystem::path& path);

/// Writes both files of the pair; neither is replaced unless both could be written.
void write_msms(const std::filesystem::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options);

}  // namespace smopt
