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

/// Two rings like links of a chain: they cannot shrink to nothing without passing through each other.
TriangleMesh linked_rings();

/// A thin tube along a trefoil knot, 100 × 6 vertices: it shrinks onto itself.
TriangleMesh knotted_tube();

/// A sphere of radius 1 with a few needles of length 5, and a speck inside the first of them, at 0.6 of its length.
TriangleMesh needles_with_a_speck_in_one();

/// A sphere of radius 1 with a few dents down to 0.1, and a speck and a thin plate floating in the first of them.
TriangleMesh dents_with_things_in_one();

/// Two plates of which the lower one's top and the upper one's bottom are the same noisy sheet, `gap` apart.
TriangleMesh plates_on_a_noisy_sheet(double gap, std::uint32_t seed);

/// The Gaussian surface of randomly placed atoms: necks, handles, and now and then a second component.
TriangleMesh random_molecule_surface(std::size_t atoms, std::uint32_t seed);

/// One new vertex of valence 3 in every face, at random places well inside.
TriangleMesh with_points_in_faces(const TriangleMesh& mesh, std::uint32_t seed);

/// One new vertex of valence 4 on every edge in random order, each splitting the two triangles that the edge then has.
TriangleMesh with_points_on_edges(const TriangleMesh& mesh, std::uint32_t seed);

}  // namespace smopt::testing
