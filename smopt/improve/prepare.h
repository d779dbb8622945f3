#pragma once

#include <cstddef>

#include "smopt/improve/cavities.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/mesh/validity.h"
#include "smopt/timing.h"

namespace smopt {

/// What was done before any method touched the mesh.
struct PreparationReport {
  ValidityReport validity;
  std::size_t isolated_vertices = 0;  ///< removed: no triangle used them
  std::size_t turned_triangles = 0;   ///< turned so that neighbours agree
  bool was_inward = false;            ///< the whole mesh was turned outwards
  CavityReport cavities;
  StageTimes seconds;  ///< "validity" and "cavities"
};

/// The stage before any method: checks validity, turns the mesh the right way round, removes cavities.
///
/// Triangles that disagree with their neighbours are turned; then the whole mesh is turned if its component of largest absolute volume
/// points inwards (as TMSmesh writes it). Isolated vertices are removed. \throws InvalidMesh naming the faults and their places when the
/// mesh is not a closed manifold of finite coordinates. Cost: O(n).
PreparationReport prepare(TriangleMesh& mesh, CavityPolicy cavities);

}  // namespace smopt
