#pragma once

#include <vector>

#include "smopt/geometry/normal_cone.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A surface in motion with what the guards know about it: shared by the guards of all threads, each of which keeps to a region of its own.
struct GuardedSurface {
  /// \pre `mesh_rings` are the mesh's; both stay alive, and the mesh changes only through guards. Cost: O(n), all cores.
  GuardedSurface(TriangleMesh& surface_mesh, const VertexRings& mesh_rings);

  TriangleMesh& mesh;
  const VertexRings& rings;
  TriangleGrid grid;
  std::vector<NormalCone> cones;  ///< per vertex: of its star's normals
};

}  // namespace smopt
