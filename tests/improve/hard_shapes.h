#pragma once

#include <cstddef>
#include <cstdint>

#include "smopt/mesh/triangle_mesh.h"

/// Closed, outward meshes that are hard to move in.
namespace smopt::testing {

/// The regular octahedron with corners (±1, 0, 0), (0, ±1, 0), (0, 0, ±1), every valence 4.
TriangleMesh octahedron();

/// A box of n × n unit squares on top and bottom, the top at z = thickness / 2 and the bottom at −thickness / 2. Point (i, j) of the top is
/// i (n + 1) + j, that of the bottom (n + 1)² more; inner points have valence 6.
TriangleMesh plate(int n, double thickness);

/// Every `every`th point moved away from the origin by the factor: needles where it is large, dents reaching for the middle where small.
TriangleMesh spiky(TriangleMesh mesh, std::size_t every, double factor);

/// One new vertex of valence 3 in every face, at random places well inside.
TriangleMesh with_points_in_faces(const TriangleMesh& mesh, std::uint32_t seed);

/// One new vertex of valence 4 on every edge in random order, each splitting the two triangles that the edge then has.
TriangleMesh with_points_on_edges(const TriangleMesh& mesh, std::uint32_t seed);

}  // namespace smopt::testing
