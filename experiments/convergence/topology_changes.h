#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "experiments/convergence/euler_parts.h"

namespace smopt::experiments {

/// The cube from plane i to plane i + 1 on each axis.
using LatticeCell = std::array<std::int32_t, 3>;

/// The cube that holds a point.
LatticeCell cell_at(const CellLattice& lattice, const Vec3& x);

/// The cubes and those that touch them; ascending, each once.
std::vector<LatticeCell> widened(std::span<const LatticeCell> cells);

/// A place where one surface's topology is not that of another.
struct TopologyChange {
  std::vector<LatticeCell> cells;  ///< ascending; connected by corners
  std::int64_t change = 0;         ///< of the Euler characteristic; not zero
};

/// Where the Euler characteristic changes between two surfaces on one lattice. Cubes on which the surfaces differ in any part, boundary
/// included, are put into groups that touch; outside of them the surfaces cross every cube, face and edge alike. The groups whose
/// characteristic is the same in both are left out: there the surface moved to other edges of the lattice and is what it was.
/// \return in the order of their first cells; the changes sum up to that of the whole. Cost: O(n log n) for n parts.
std::vector<TopologyChange> topology_changes(std::span<const EulerPart> before, std::span<const EulerPart> after);

}  // namespace smopt::experiments
