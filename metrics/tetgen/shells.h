#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// The closed pieces of a surface: triangles connected through edges.
struct Shells {
  std::vector<std::uint32_t> of_triangle;     ///< the shell of each triangle, numbered from 0
  std::vector<std::optional<double>> volume;  ///< Å³, what each shell encloses, not signed; empty for one that is open or one-sided
};

/// TetGen does not look at the orientation of triangles, so a shell whose triangles are turned this way and that is made consistent first.
/// Cost: O(n).
Shells find_shells(const TriangleMesh& mesh);

}  // namespace smopt::metrics
