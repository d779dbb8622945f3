#include "tests/surface/adaptive_interpolant.h"

#include <algorithm>
#include <limits>

#include "smopt/surface/cell_surroundings.h"

namespace smopt::testing {
namespace {

/// The finest level of a cell that is there.
int finest_level(const AdaptivePartition& partition) {
  int level = 0;
  for (const CellForest::Cell& cell : partition.forest.cells()) level = std::max(level, cell.place.level);
  return level;
}

double trilinear(const cube::CornerValues& values, const Vec3& place) {
  double sum = 0;
  for (int corner = 0; corner < cube::kCorners; ++corner) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? place[axis] : 1 - place[axis];
    sum += weight * values[corner];
  }
  return sum;
}

/// Fills what no cell has said: along x, with the sign of what comes before.
void fill_gaps(ScalarGrid& grid) {
  for (std::size_t row = 0; row < grid.values.size(); row += grid.size[0]) {
    double before = -1;
    for (std::size_t i = row; i < row + grid.size[0]; ++i) {
      if (std::isnan(grid.values[i])) grid.values[i] = before >= 0 ? 1 : -1;
      before = grid.values[i];
    }
  }
}

}  // namespace

double interpolant_in_leaf(const AdaptivePartition& partition, CellForest::Id leaf, const Vec3& place) {
  CellFinder finder(partition.forest);
  return trilinear(continuous_values(finder, leaf, surroundings_of(finder, leaf)), place);
}

Vec3 position_in_leaf(const AdaptivePartition& partition, CellForest::Id leaf, const Vec3& place) {
  const CellPlace& cell = partition.forest.cell(leaf).place;
  const Vec3 at(cell.at[0], cell.at[1], cell.at[2]);
  return partition.lattice.origin + partition.lattice.edge(cell.level) * (at + place);
}

void for_each_leaf(const AdaptivePartition& partition, const std::function<void(CellForest::Id)>& visit) {
  for (CellForest::Id id = 0; id < static_cast<CellForest::Id>(partition.forest.cells().size()); ++id) {
    if (partition.forest.is_leaf(id)) visit(id);
  }
}

ScalarGrid sampled_interpolant(const AdaptivePartition& partition, int halvings) {
  const int finest = finest_level(partition) + halvings;
  std::array<std::int32_t, 3> first{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max(),
                                    std::numeric_limits<std::int32_t>::max()};
  std::array<std::int32_t, 3> last{};
  for (const CellForest::Cell& cell : partition.forest.cells()) {
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = std::min(first[axis], cell.place.at[axis] << (finest - cell.place.level));
      last[axis] = std::max(last[axis], (cell.place.at[axis] + 1) << (finest - cell.place.level));
    }
  }
  ScalarGrid grid;
  for (int axis = 0; axis < 3; ++axis) grid.size[axis] = static_cast<std::uint32_t>(last[axis] - first[axis] + 3);
  grid.values.assign(grid.node_count(), std::nan(""));
  for_each_leaf(partition, [&](CellForest::Id leaf) {
    const CellPlace& place = partition.forest.cell(leaf).place;
    CellFinder finder(partition.forest);
    const cube::CornerValues values = continuous_values(finder, leaf, surroundings_of(finder, leaf));
    const int n = 1 << (finest - place.level);
    for (int k = 0; k <= n; ++k) {
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          const std::size_t at =
              grid.index(place.at[0] * n + i - first[0] + 1, place.at[1] * n + j - first[1] + 1, place.at[2] * n + k - first[2] + 1);
          grid.values[at] = trilinear(values, Vec3(i, j, k) / n);
        }
      }
    }
  });
  fill_gaps(grid);
  return grid;
}

}  // namespace smopt::testing
