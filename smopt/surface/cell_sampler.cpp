#include "smopt/surface/cell_sampler.h"

#include <algorithm>
#include <cmath>

namespace smopt {
namespace {

/// The samples of a cell: its corners, and the middles of its edges, of its faces and of itself; x fastest.
constexpr int kSide = 3;
using Samples = std::array<double, kSide * kSide * kSide>;

constexpr int sample_index(int i, int j, int k) {
  return (k * kSide + j) * kSide + i;
}

/// The error of the interpolant is largest in the middle of an edge, of a face or of the cell while φ is quadratic; this allows for φ being
/// not quite that over a cell.
constexpr double kErrorMargin = 1.25;

/// Between samples φ differs from their interpolant by a quarter of the cell's error (it goes with the square of the spacing); with a margin.
constexpr double kErrorBetweenSamples = 0.3;

cube::CornerValues corners_of(const Samples& f) {
  cube::CornerValues corners;
  for (int corner = 0; corner < cube::kCorners; ++corner)
    corners[corner] = f[sample_index(2 * (corner & 1), 2 * (corner >> 1 & 1), 2 * (corner >> 2))];
  return corners;
}

/// The trilinear interpolant at sample (i, j, k): the mean of the corners at both ends of every axis on which the sample is in the middle.
double interpolant_at(const Samples& f, int i, int j, int k) {
  double sum = 0;
  for (const int x : {i == 2 ? 2 : 0, i == 0 ? 0 : 2}) {
    for (const int y : {j == 2 ? 2 : 0, j == 0 ? 0 : 2}) {
      for (const int z : {k == 2 ? 2 : 0, k == 0 ? 0 : 2}) sum += f[sample_index(x, y, z)];
    }
  }
  return sum / cube::kCorners;
}

Samples interpolant_of(const Samples& f) {
  Samples interpolant;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) interpolant[sample_index(i, j, k)] = interpolant_at(f, i, j, k);
    }
  }
  return interpolant;
}

double largest_difference(const Samples& f, const Samples& g) {
  double largest = 0;
  for (std::size_t i = 0; i < f.size(); ++i) largest = std::max(largest, std::abs(f[i] - g[i]));
  return largest;
}

/// One eighth of a cell, between the samples of which it has the corners.
class Octant {
 public:
  Octant(const Samples& f, const Samples& interpolant, int number) {
    for (int corner = 0; corner < cube::kCorners; ++corner) {
      const int at = sample_index((number & 1) + (corner & 1), (number >> 1 & 1) + (corner >> 1 & 1), (number >> 2) + (corner >> 2));
      values_[corner] = f[at];
      interpolant_[corner] = interpolant[at];
    }
  }

  /// Whether φ = c or the interpolant's surface may pass when φ is off by `error` between the samples.
  [[nodiscard]] bool may_be_crossed(double error) const {
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    const auto [low_interpolant, high_interpolant] = std::minmax_element(interpolant_.begin(), interpolant_.end());
    return std::min(*low - error, *low_interpolant) <= 0 && std::max(*high + error, *high_interpolant) >= 0;
  }

  [[nodiscard]] double error() const {
    double largest = 0;
    for (int corner = 0; corner < cube::kCorners; ++corner) largest = std::max(largest, std::abs(values_[corner] - interpolant_[corner]));
    return kErrorMargin * largest;
  }

  /// Bits: axes along which all differences are positive (0 to 2), or negative (3 to 5).
  [[nodiscard]] unsigned monotone_axes() const { return cube::monotone_axes(values_); }

  /// The least |∇φ|: along each axis the least of the differences, or 0 where they have both signs.
  [[nodiscard]] double least_slope(double sample_spacing) const {
    return Vec3(least_difference(0), least_difference(1), least_difference(2)).norm() / sample_spacing;
  }

 private:
  [[nodiscard]] double least_difference(int axis) const {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int corner = 0; corner < cube::kCorners; ++corner) {
      if ((corner >> axis & 1) != 0) continue;
      const double difference = values_[corner | 1 << axis] - values_[corner];
      low = std::min(low, difference);
      high = std::max(high, difference);
    }
    return low > 0 ? low : high < 0 ? -high : 0;
  }

  cube::CornerValues values_{};
  cube::CornerValues interpolant_{};
};

/// Finds the octant in which the surface may be farthest off, and the axes along which φ is monotone in all octants that may be crossed.
void judge(const Samples& f, double sample_spacing, CellForest::Cell& cell) {
  const Samples interpolant = interpolant_of(f);
  const double between_samples = kErrorBetweenSamples * kErrorMargin * largest_difference(f, interpolant);
  double largest = -1;
  unsigned monotone_axes = cube::kAllAxes;
  for (int number = 0; number < cube::kCorners; ++number) {
    const Octant octant(f, interpolant, number);
    if (!octant.may_be_crossed(between_samples)) continue;
    cell.may_be_crossed = true;
    monotone_axes &= octant.monotone_axes();
    const double error = octant.error();
    const double slope = octant.least_slope(sample_spacing);
    const double distance = slope > 0 ? error / slope : HUGE_VAL;
    if (distance <= largest) continue;
    largest = distance;
    cell.error = static_cast<float>(error);
    cell.slope = static_cast<float>(slope);
  }
  cell.monotone_axes = static_cast<std::uint8_t>(monotone_axes);
}

}  // namespace

ScalarGrid CellLattice::nodes(const CellPlace& first_cell, const std::array<std::int32_t, 3>& cells, int halvings) const {
  ScalarGrid grid;
  grid.origin = origin;
  grid.spacing = edge(first_cell.level + halvings);
  for (int axis = 0; axis < 3; ++axis) {
    grid.first[axis] = first_cell.at[axis] << halvings;
    grid.size[axis] = static_cast<std::uint32_t>((cells[axis] << halvings) + 1);
  }
  return grid;
}

CellForest::Cell CellSampler::judged(const CellPlace& place, const ScalarGrid& samples, const std::array<std::size_t, 3>& node) const {
  Samples f;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const std::size_t at = samples.index(node[0] + static_cast<std::size_t>(i), node[1] + static_cast<std::size_t>(j),
                                             node[2] + static_cast<std::size_t>(k));
        f[sample_index(i, j, k)] = samples.values[at] - isovalue_;
      }
    }
  }
  CellForest::Cell cell;
  cell.place = place;
  cell.values = corners_of(f);
  judge(f, samples.spacing, cell);
  return cell;
}

std::vector<CellForest::Cell> CellSampler::block_of_roots(const std::array<std::int32_t, 3>& first, std::int32_t edge) const {
  ScalarGrid samples = lattice_.nodes({first, 0}, {edge, edge, edge}, 1);
  field_.sample(samples, SampleBits::of_position);
  std::vector<CellForest::Cell> cells;
  const auto n = static_cast<std::size_t>(edge);
  cells.reserve(n * n * n);
  for (std::int32_t k = 0; k < edge; ++k) {
    for (std::int32_t j = 0; j < edge; ++j) {
      for (std::int32_t i = 0; i < edge; ++i) {
        const std::array<std::size_t, 3> node = {2 * static_cast<std::size_t>(i), 2 * static_cast<std::size_t>(j),
                                                 2 * static_cast<std::size_t>(k)};
        cells.push_back(judged({{first[0] + i, first[1] + j, first[2] + k}, 0}, samples, node));
      }
    }
  }
  return cells;
}

std::array<CellForest::Cell, cube::kCorners> CellSampler::children(const CellPlace& parent) const {
  ScalarGrid samples = lattice_.nodes(parent, {1, 1, 1}, 2);
  field_.sample(samples, SampleBits::of_position);
  std::array<CellForest::Cell, cube::kCorners> cells;
  for (int corner = 0; corner < cube::kCorners; ++corner) {
    const std::array<std::size_t, 3> node = {2 * static_cast<std::size_t>(corner & 1), 2 * static_cast<std::size_t>(corner >> 1 & 1),
                                             2 * static_cast<std::size_t>(corner >> 2)};
    cells[static_cast<std::size_t>(corner)] = judged(parent.child(corner), samples, node);
  }
  return cells;
}

}  // namespace smopt
