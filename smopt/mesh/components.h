#pragma once

#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The connected components of a mesh: triangles that share a vertex belong together. Numbered by their first triangle.
struct Components {
  std::size_t count = 0;
  std::vector<std::uint32_t> of_triangle;  ///< one entry a triangle
};

/// Cost: O(n).
Components connected_components(const TriangleMesh& mesh);

}  // namespace smopt
