#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// What TetGen made of a surface. The points of the surface come first, under the same indices.
struct TetMesh {
  std::vector<Vec3> points;                         ///< ångström
  std::vector<std::array<VertexId, 4>> tetrahedra;  ///< det(b − a, c − a, d − a) > 0, as TetGen, VTK and Gmsh order them
  std::vector<Triangle> boundary_faces;             ///< faces that lie in the surface
  std::vector<FaceId> surface_triangle;             ///< for each of them, the triangle of the surface it lies in
};

}  // namespace smopt::metrics
