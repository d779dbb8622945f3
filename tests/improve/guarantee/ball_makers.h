#pragma once

#include "smopt/mesh/triangle_mesh.h"
#include "tests/improve/guarantee/random.h"

/// Spheres, tori, needles and what may float beside them: closed meshes, outward or with cavities. `roughness` in [0, 1] scales what is
/// random about the positions; the smaller, the likelier it is that no two triangles intersect.
namespace smopt::testing {

TriangleMesh noisy_sphere(Random& random, double roughness);
TriangleMesh noisy_torus(Random& random, double roughness);

/// A sphere with many needles, up to twenty times its radius long.
TriangleMesh needles(Random& random, double roughness);

/// A sphere with spikes, and specks inside and beside the spikes: in the way of their retreat.
TriangleMesh spikes_with_specks(Random& random, double roughness);

/// A sphere with deep dents, and specks floating in them.
TriangleMesh dents_with_specks(Random& random, double roughness);

/// A sphere around another one (a cavity or not), 1e-12 to 1e-3 apart.
TriangleMesh shells_that_nearly_touch(Random& random, double roughness);

/// Cavities in islands in cavities, and other components beside them.
TriangleMesh nested_components(Random& random, double roughness);

/// A chain of tori.
TriangleMesh linked_tori(Random& random, double roughness);

/// A tube along a knot.
TriangleMesh knot(Random& random, double roughness);

/// A sphere whose radius, and so its edges, go from 1e-4 to 10.
TriangleMesh badly_graded_sphere(Random& random, double roughness);

/// A sphere or torus pressed until it is 1e-12 to 1e-2 of its height.
TriangleMesh flattened(Random& random, double roughness);

/// A closed mesh with vertices of valence 3 and 4 in its faces and on its edges, not all of them exactly.
TriangleMesh redundant_points(Random& random, double roughness);

/// What marching cubes make of a random molecule.
TriangleMesh lattice(Random& random, double roughness);

/// Two vertices with a triangle to each edge of a large ring.
TriangleMesh fans(Random& random, double roughness);

/// Two vertices close together, with a triangle to each edge of a ring that goes up and down: stars that no direction shows one-to-one.
TriangleMesh pleats(Random& random, double roughness);

/// A sphere or torus with as much noise as it bears without intersections: a little less than what makes some.
TriangleMesh crumpled(Random& random, double roughness);

/// A sphere with tetrahedra hovering 1e-10 to 1e-3 above and below its faces.
TriangleMesh hovering_specks(Random& random, double roughness);

/// Many small tetrahedra, some within others.
TriangleMesh tetrahedra(Random& random, double roughness);

}  // namespace smopt::testing
