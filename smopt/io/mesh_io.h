#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// How a mesh is written.
struct MeshWriteOptions {
  int digits = 0;  ///< significant digits of text formats, 1..17; 0: as many as it takes to read the same doubles back
};

/// Reads a mesh; the format follows from the name's ending (OFF, PLY, STL, OBJ, VTP, MSMS .vert/.face; each with `.gz` too), `-` is OFF
/// from standard input. Coordinates that are not finite are read as they are: whoever needs finite ones checks. \throws InvalidInput naming
/// the file and the line (or element) where it cannot be parsed: wrong header, counts that do not match, an index out of range, a polygon
/// that is not a triangle.
TriangleMesh read_mesh(const std::filesystem::path& path);

/// Writes a mesh beside `path` and renames it, so that no half-written file is ever left. `-` is OFF on standard output.
/// \throws InvalidInput when the format is unknown or the file cannot be written.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options = {});

/// Whether `path` names a format that can be read (written), without touching the file.
bool is_readable_mesh_format(const std::filesystem::path& path);
bool is_writable_mesh_format(const std::filesystem::path& path);

/// One line for help texts and error messages: "off, ply, stl, obj, vtp, vert/face".
std::string mesh_format_names();

}  // namespace smopt
