#pragma once

#include <cstddef>
#include <vector>

#include "smopt/mesh/components.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Turns single triangles so that neighbours agree (each edge is used once in each direction), component by component, starting from the
/// first triangle of each. Returns how many were turned. \pre every edge has exactly two triangles. \throws InvalidMesh naming the edge
/// where the surface is one-sided (a Klein bottle). Cost: O(n log n).
std::size_t orient_consistently(TriangleMesh& mesh);

/// Enclosed volume of each component, Å³: positive where its normals point outwards. \pre closed and consistently oriented.
std::vector<double> component_volumes(const TriangleMesh& mesh, const Components& components);

/// Enclosed volume of the whole mesh, Å³: cavities count negative. \pre closed and consistently oriented. Cost: O(n).
double signed_volume(const TriangleMesh& mesh);

/// Turns every triangle round.
void reverse_orientation(TriangleMesh& mesh);

}  // namespace smopt
