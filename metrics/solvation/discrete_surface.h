#pragma once

#include <vector>

#include "metrics/solvation/node_patches.h"
#include "smopt/mesh/stars.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// A surface with what the boundary elements need of it. \pre closed, oriented outwards, each vertex in a triangle.
struct DiscreteSurface {
  explicit DiscreteSurface(TriangleMesh surface) : mesh(std::move(surface)), stars(build_stars(mesh)), patches(node_patches(mesh, stars)) {}

  TriangleMesh mesh;
  VertexStars stars;
  std::vector<NodePatch> patches;

  [[nodiscard]] std::size_t size() const { return patches.size(); }
};

}  // namespace smopt::metrics
