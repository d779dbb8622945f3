#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/surface/cell_sampler.h"

namespace smopt::experiments {

/// A part of space that a lattice of cubes divides it into: an open cube, or an open face, edge or corner of cubes. On each axis 2i + 1
/// stands for the open interval between planes i and i + 1, and 2i for plane i.
using LatticePart = std::array<std::int32_t, 3>;

/// V − E + T of what of a surface lies in one part.
struct EulerPart {
  LatticePart part{};
  std::int64_t euler = 0;

  bool operator==(const EulerPart&) const = default;
};

/// The Euler characteristic of a surface, part by part: a vertex, edge or triangle belongs to the part that holds its centroid; what lies in
/// a plane to `kOnPlane` counts as on it. The sum over all parts is the surface's.
/// \pre the mesh is closed and oriented, so that each edge is run through once in either direction.
/// \return parts with something other than zero, ascending. Cost: O(n), on one thread.
std::vector<EulerPart> euler_by_parts(const TriangleMesh& mesh, const CellLattice& lattice);

/// Ångström: coordinates of some hundred ångström are exact to 1e-13, and the sampler puts vertices on planes to the last bit.
inline constexpr double kOnPlane = 1e-9;

}  // namespace smopt::experiments
