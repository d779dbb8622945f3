#pragma once

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// An icosahedron around the origin whose triangles are divided into four `divisions` times, all vertices on the sphere: 10·4^divisions + 2 of them,
/// outwards. \param radius  ångström.
TriangleMesh icosphere(int divisions, double radius);

}  // namespace smopt::experiments
