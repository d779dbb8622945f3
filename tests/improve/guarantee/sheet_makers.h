#pragma once

#include "smopt/mesh/triangle_mesh.h"
#include "tests/improve/guarantee/random.h"

/// Plates, folds, rolls and polycubes: closed meshes made of flat or nearly flat sheets. `roughness` in [0, 1] scales what is random about
/// the positions; the smaller, the likelier it is that no two triangles intersect.
namespace smopt::testing {

/// Two noisy sheets facing each other, 1e-12 to 1e-3 apart.
TriangleMesh sheets_that_nearly_touch(Random& random, double roughness);

/// A bent plate, 1e-9 to 1e-3 thick.
TriangleMesh thin_plate(Random& random, double roughness);

/// A thin plate in zigzag folds that nearly lie on each other.
TriangleMesh accordion(Random& random, double roughness);

/// A thin plate rolled up, its layers nearly touching.
TriangleMesh swiss_roll(Random& random, double roughness);

/// A plate on a grid whose lines are 1e-4 to 10 apart.
TriangleMesh badly_graded_plate(Random& random, double roughness);

/// A box with exactly coplanar top and bottom whose inner points lie anywhere in their plane.
TriangleMesh coplanar_box(Random& random, double roughness);

/// The surface of a random set of unit cubes, each square cut in two.
TriangleMesh polycube(Random& random, double roughness);

}  // namespace smopt::testing
