#pragma once

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// An open square of n × n squares of side 1, each two triangles.
inline TriangleMesh flat_lattice(VertexId n) {
  TriangleMesh mesh;
  for (VertexId i = 0; i <= n; ++i)
    for (VertexId j = 0; j <= n; ++j) mesh.points.emplace_back(i, j, 0);
  for (VertexId i = 0; i < n; ++i) {
    for (VertexId j = 0; j < n; ++j) {
      const VertexId a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  }
  return mesh;
}

}  // namespace smopt::testing
