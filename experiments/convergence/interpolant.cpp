#include "experiments/convergence/interpolant.h"

#include <cmath>

#include "smopt/surface/cell_surroundings.h"

namespace smopt::experiments {
namespace {

CellPlace finest_place_at(const CellLattice& lattice, const Vec3& x) {
  CellPlace place;
  place.level = lattice.finest_level;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::floor((x[axis] - lattice.origin[axis]) / lattice.edge(place.level));
    place.at[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(at);
  }
  return place;
}

double trilinear(const cube::CornerValues& values, const Vec3& t) {
  double sum = 0;
  for (int corner = 0; corner < cube::kCorners; ++corner) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? t[axis] : 1 - t[axis];
    sum += weight * values[static_cast<std::size_t>(corner)];
  }
  return sum;
}

}  // namespace

std::optional<double> interpolant_at(const AdaptivePartition& partition, const Vec3& x) {
  const auto& [lattice, forest] = partition;
  CellFinder finder(forest);
  const CellForest::Id leaf = finder.find(finest_place_at(lattice, x)).id;
  if (leaf == CellForest::kNone) return std::nullopt;
  const CellPlace& place = forest.cell(leaf).place;
  const Vec3 low(place.at[0], place.at[1], place.at[2]);
  const Vec3 t = (x - lattice.origin) / lattice.edge(place.level) - low;
  return trilinear(continuous_values(finder, leaf, surroundings_of(finder, leaf)), t);
}

}  // namespace smopt::experiments
