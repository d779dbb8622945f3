#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

/// How the triangles hang together, and what is wrong with them. All counts are exact.
struct Topology {
  std::size_t vertices = 0;               ///< all points, those in no triangle too
  std::size_t triangles = 0;              ///< all faces
  std::size_t edges = 0;                  ///< undirected sides; a face that names a vertex twice has none
  std::size_t components = 0;             ///< of triangles that share a vertex by index
  std::int64_t euler_characteristic = 0;  ///< V − E + F, with V the vertices that are in a triangle
  std::optional<std::int64_t>
      genus;                   ///< components − χ/2, summed over the components; of closed manifolds only, which it takes as orientable
  bool closed = false;         ///< there are triangles, and no edge has one triangle only
  bool edge_manifold = false;  ///< no edge has more than two triangles, and no face names a vertex twice
  bool vertex_manifold = false;          ///< the triangles at each vertex form one fan, open or closed
  bool oriented = false;                 ///< every edge inside the surface is run through as often in one direction as in the other
  std::size_t isolated_vertices = 0;     ///< points in no triangle
  std::size_t duplicate_vertices = 0;    ///< points whose coordinates exactly equal those of one before it (−0 equals 0)
  std::size_t degenerate_triangles = 0;  ///< faces with corners exactly on a line
  std::size_t nonfinite_vertices = 0;    ///< points with a coordinate that is infinite or not a number
};

/// Measures any triangle soup: open, non-manifold, empty. Whoever finds `genus` empty is told why in `notes`.
/// Cost: O(n log n), for the duplicate vertices.
Topology measure_topology(const TriangleMesh& mesh, std::vector<std::string>& notes);

}  // namespace smopt::metrics
