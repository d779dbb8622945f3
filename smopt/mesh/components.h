#pragma once

#include <limits>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The connected components of a mesh: triangles that share a vertex belong together. Numbered by their first triangle.
struct Components {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::size_t count = 0;
  std::vector<std::uint32_t> of_triangle;  ///< one entry a triangle
  std::vector<std::uint32_t> of_vertex;    ///< one entry a vertex; kNone where no triangle uses it
};

/// Cost: O(n), on all threads.
Components connected_components(const TriangleMesh& mesh);

}  // namespace smopt
