#pragma once

#include <vector>

#include "smopt/geometry/normal_cone.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A surface in motion with what the guards know about it: shared by the guards of all threads, each of which keeps to a region of its own.
struct GuardedSurface {
  /// \pre `mesh_rings` are the mesh's; both stay alive, and the mesh changes only through guards.
  GuardedSurface(TriangleMesh& surface_mesh, const VertexRings& mesh_rings)
      : mesh(surface_mesh), rings(mesh_rings), grid(surface_mesh.points, surface_mesh.triangles), axes(surface_mesh.vertex_count()) {}

  TriangleMesh& mesh;
  const VertexRings& rings;
  TriangleGrid grid;
  std::vector<ConeAxis> axes;  ///< per vertex: the axis of its normal cone, zero where none is known
};

}  // namespace smopt
