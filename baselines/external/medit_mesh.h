#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// The text format of Medit (Frey, INRIA RT-0253, 2001), `.mesh`, which MMG reads and writes: as much of it as a surface needs.
///
/// Takes `Vertices` and `Triangles` of three dimensions, and passes over every other section. \param name how messages call the text.
/// \throws InvalidInput "name:line: what is wrong". Cost: O(bytes).
TriangleMesh parse_medit(std::string_view text, const std::string& name);

/// Every double reads back as itself; references are 0.
std::string format_medit(const TriangleMesh& mesh);

/// \throws InvalidInput.
TriangleMesh read_medit(const std::filesystem::path& path);

}  // namespace smopt::baselines
