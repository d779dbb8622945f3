#include "experiments/convergence/topology_changes.h"

#include <algorithm>
#include <cmath>

#include "smopt/mesh/disjoint_sets.h"
#include "smopt/surface/place_map.h"

namespace smopt::experiments {
namespace {

std::vector<EulerPart> differences(std::span<const EulerPart> before, std::span<const EulerPart> after) {
  std::vector<EulerPart> result;
  auto b = before.begin();
  auto a = after.begin();
  while (b != before.end() || a != after.end()) {
    if (a == after.end() || (b != before.end() && b->part < a->part)) {
      result.push_back({b->part, -b->euler});
      ++b;
    } else if (b == before.end() || a->part < b->part) {
      result.push_back(*a);
      ++a;
    } else {
      if (a->euler != b->euler) result.push_back({a->part, a->euler - b->euler});
      ++a;
      ++b;
    }
  }
  return result;
}

/// The cube to which a part belongs: every plane to the cube above it.
LatticeCell cell_of(const LatticePart& part) {
  return {part[0] >> 1, part[1] >> 1, part[2] >> 1};
}

/// Visits the cubes that have the part in them or on their boundary: a plane is on two.
template <class Visit>
void for_cells_at(const LatticePart& part, const Visit& visit) {
  const LatticeCell last = cell_of(part);
  LatticeCell first;
  for (std::size_t axis = 0; axis < 3; ++axis) first[axis] = (part[axis] - 1) >> 1;
  for (std::int32_t k = first[2]; k <= last[2]; ++k) {
    for (std::int32_t j = first[1]; j <= last[1]; ++j) {
      for (std::int32_t i = first[0]; i <= last[0]; ++i) visit(LatticeCell{i, j, k});
    }
  }
}

PlaceMap<3> numbered(std::span<const LatticeCell> cells) {
  PlaceMap<3> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i) numbers.find_or_add(cells[i], static_cast<std::int32_t>(i));
  return numbers;
}

/// Visits the cube and the 26 that touch it.
template <class Visit>
void for_cells_about(const LatticeCell& cell, const Visit& visit) {
  for (std::int32_t k = -1; k <= 1; ++k) {
    for (std::int32_t j = -1; j <= 1; ++j) {
      for (std::int32_t i = -1; i <= 1; ++i) visit(LatticeCell{cell[0] + i, cell[1] + j, cell[2] + k});
    }
  }
}

void make_unique(std::vector<LatticeCell>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

std::vector<LatticeCell> cells_at(std::span<const EulerPart> parts) {
  std::vector<LatticeCell> cells;
  for (const EulerPart& part : parts) for_cells_at(part.part, [&](const LatticeCell& cell) { cells.push_back(cell); });
  make_unique(cells);
  return cells;
}

DisjointSets joined_where_they_touch(std::span<const LatticeCell> cells, const PlaceMap<3>& numbers) {
  DisjointSets sets(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for_cells_about(cells[n], [&](const LatticeCell& other) {
      const std::int32_t number = numbers.find(other);
      if (number != PlaceMap<3>::kNone) sets.unite(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(number));
    });
  }
  return sets;
}

}  // namespace

LatticeCell cell_at(const CellLattice& lattice, const Vec3& x) {
  LatticeCell cell;
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::floor((x[axis] - lattice.origin[axis]) / lattice.root_edge));
  return cell;
}

std::vector<LatticeCell> widened(std::span<const LatticeCell> cells) {
  std::vector<LatticeCell> result;
  for (const LatticeCell& cell : cells) for_cells_about(cell, [&](const LatticeCell& other) { result.push_back(other); });
  make_unique(result);
  return result;
}

std::vector<TopologyChange> topology_changes(std::span<const EulerPart> before, std::span<const EulerPart> after) {
  const std::vector<EulerPart> changed = differences(before, after);
  const std::vector<LatticeCell> cells = cells_at(changed);
  const PlaceMap<3> numbers = numbered(cells);
  DisjointSets sets = joined_where_they_touch(cells, numbers);

  std::vector<TopologyChange> groups(cells.size());  // at the number of each group's first cell
  for (std::size_t n = 0; n < cells.size(); ++n) groups[sets.root(static_cast<std::uint32_t>(n))].cells.push_back(cells[n]);
  for (const EulerPart& part : changed) {
    const std::int32_t number = numbers.find(cell_of(part.part));
    groups[sets.root(static_cast<std::uint32_t>(number))].change += part.euler;
  }
  std::erase_if(groups, [](const TopologyChange& group) { return group.change == 0; });
  return groups;
}

}  // namespace smopt::experiments
