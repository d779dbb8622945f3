#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// How a mesh is written.
struct MeshWriteOptions {
  int digits = 0;  ///< significant digits of text formats, 1..17; 0: as many as it takes to read the same doubles back
};

/// A number at each vertex, under a name.
struct VertexScalars {
  std::string name;                ///< letters, digits and "_", and none of x, y, z, which PLY has for the position
  std::span<const double> values;  ///< one a vertex; those that are not finite are written as they are
};

/// Reads a mesh; the format follows from the name's ending (OFF, PLY, STL, OBJ, VTP, MSMS .vert/.face; each with `.gz` too), `-` is OFF
/// from standard input. Coordinates that are not finite are read as they are: whoever needs finite ones checks. \throws InvalidInput naming
/// the file and the line (or element) where it cannot be parsed: wrong header, counts that do not match, an index out of range, a polygon
/// that is not a triangle.
TriangleMesh read_mesh(const std::filesystem::path& path);

/// Writes a mesh beside `path` and renames it, so that no half-written file is ever left. `-` is OFF on standard output.
/// \throws InvalidInput when the format is unknown or the file cannot be written.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options = {});

/// Writes a mesh with numbers at its vertices: VTP (point data, the first array active) or PLY (properties of the vertices), each with
/// `.gz` too, all as binary doubles. `read_mesh` reads the mesh back and passes over the numbers.
/// \throws InvalidInput when the format is another one or the file cannot be written; InvalidOption when a name cannot be one or is there
/// twice, or an array's length is not the number of vertices.
void write_mesh_with_scalars(const std::filesystem::path& path, const TriangleMesh& mesh, std::span<const VertexScalars> scalars);

/// Whether `path` names a format that holds numbers at the vertices, without touching the file.
bool is_scalar_mesh_format(const std::filesystem::path& path);

/// Whether `path` names a format that can be read (written), without touching the file.
bool is_readable_mesh_format(const std::filesystem::path& path);
bool is_writable_mesh_format(const std::filesystem::path& path);

/// One line for help texts and error messages: "off, ply, stl, obj, vtp, vert/face".
std::string mesh_format_names();

/// Likewise, those that hold numbers at the vertices: "ply, vtp".
std::string scalar_mesh_format_names();

}  // namespace smopt
