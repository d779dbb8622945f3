#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// Edges at a vertex, over the vertices that are in a triangle; empty where there is none.
struct Valence {
  std::optional<std::size_t> min, max;
  std::optional<double> share_6;      ///< of the vertices with valence 6
  std::optional<double> share_5_6_7;  ///< of the vertices with valence 5, 6 or 7
};

/// Cost: O(n log(valence)).
Valence measure_valence(const TriangleMesh& mesh, std::vector<std::string>& notes);

}  // namespace smopt::metrics
