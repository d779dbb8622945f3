#include "tests/surface/subdivided_field.h"

#include <algorithm>
#include <array>

namespace smopt::testing {
namespace {

using Step = std::array<int, 3>;

constexpr int kDirections = 7;  ///< non-empty sets of axes, as bits

constexpr Step step_of(int direction) {
  return {direction & 1, direction >> 1 & 1, direction >> 2 & 1};
}

/// The simplices with a given lowest node, without the node itself: chains of growing sets of axes. The sign is (-1)^dimension.
struct Simplex {
  std::vector<int> directions;
  int sign;
};

std::vector<Simplex> simplices_at_a_node() {
  std::vector<Simplex> found = {{{}, 1}};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Simplex simplex = found[i];
    const int last = simplex.directions.empty() ? 0 : simplex.directions.back();
    for (int next = last + 1; next <= kDirections; ++next) {
      if ((next & last) != last) continue;
      found.push_back(simplex);
      found.back().directions.push_back(next);
      found.back().sign = -simplex.sign;
    }
  }
  return found;
}

double trilinear(const ScalarGrid& grid, const std::array<std::size_t, 3>& cell, const Vec3& at) {
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<std::size_t, 3> bit = {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= bit[axis] ? at[axis] : 1 - at[axis];
    if (weight != 0) sum += weight * grid.values[grid.index(cell[0] + bit[0], cell[1] + bit[1], cell[2] + bit[2])];
  }
  return sum;
}

}  // namespace

SubdividedField::SubdividedField(const ScalarGrid& coarse, int factor) : factor_(factor) {
  sample(coarse);
  find_components();
  sum_simplices();
}

int SubdividedField::component_of(std::size_t i, std::size_t j, std::size_t k) const {
  const auto f = static_cast<std::size_t>(factor_);
  return component_[fine_.index(f * i, f * j, f * k)];
}

void SubdividedField::sample(const ScalarGrid& coarse) {
  const auto f = static_cast<std::size_t>(factor_);
  for (int axis = 0; axis < 3; ++axis) fine_.size[axis] = static_cast<std::uint32_t>((coarse.size[axis] - 1) * f + 1);
  fine_.values.reserve(fine_.node_count());
  for (std::size_t k = 0; k < fine_.size[2]; ++k) {
    for (std::size_t j = 0; j < fine_.size[1]; ++j) {
      for (std::size_t i = 0; i < fine_.size[0]; ++i) {
        const std::array<std::size_t, 3> node = {i, j, k};
        std::array<std::size_t, 3> cell;
        Vec3 at;
        for (int axis = 0; axis < 3; ++axis) {
          cell[axis] = std::min<std::size_t>(node[axis] / f, coarse.size[axis] - 2);
          at[axis] = static_cast<double>(node[axis] - f * cell[axis]) / factor_;
        }
        fine_.values.push_back(trilinear(coarse, cell, at));
      }
    }
  }
}

void SubdividedField::find_components() {
  component_.assign(fine_.node_count(), -1);
  int label = 0;
  for (std::size_t node = 0; node < fine_.node_count(); ++node) {
    if (component_[node] >= 0) continue;
    flood(node, label++);
    ++(fine_.values[node] >= 0 ? inside_components_ : outside_components_);
  }
}

void SubdividedField::flood(std::size_t seed, int label) {
  const bool inside = fine_.values[seed] >= 0;
  std::vector<std::size_t> open = {seed};
  component_[seed] = label;
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    const Step at = {static_cast<int>(node % fine_.size[0]), static_cast<int>(node / fine_.size[0] % fine_.size[1]),
                     static_cast<int>(node / fine_.size[0] / fine_.size[1])};
    for (int direction = 1; direction <= kDirections; ++direction) {
      for (const int way : {-1, 1}) {
        Step to = at;
        bool is_in_grid = true;
        for (int axis = 0; axis < 3; ++axis) {
          to[axis] += way * step_of(direction)[axis];
          is_in_grid = is_in_grid && to[axis] >= 0 && to[axis] < static_cast<int>(fine_.size[axis]);
        }
        if (!is_in_grid) continue;
        const std::size_t neighbour =
            fine_.index(static_cast<std::size_t>(to[0]), static_cast<std::size_t>(to[1]), static_cast<std::size_t>(to[2]));
        if (component_[neighbour] >= 0 || (fine_.values[neighbour] >= 0) != inside) continue;
        component_[neighbour] = label;
        open.push_back(neighbour);
      }
    }
  }
}

void SubdividedField::sum_simplices() {
  static const std::vector<Simplex> kSimplices = simplices_at_a_node();
  std::array<std::size_t, kDirections + 1> offset{};
  for (int d = 0; d <= kDirections; ++d) offset[d] = fine_.index(step_of(d)[0], step_of(d)[1], step_of(d)[2]);
  for (std::size_t node = 0; node < fine_.node_count(); ++node) {
    if (fine_.values[node] < 0) continue;
    const std::array<std::size_t, 3> at = {node % fine_.size[0], node / fine_.size[0] % fine_.size[1],
                                           node / fine_.size[0] / fine_.size[1]};
    int blocked = 0;  // axes on which there is no next node
    int on_face = 0;  // axes on which the node is at an end of the grid
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] + 1 == fine_.size[axis]) blocked |= 1 << axis;
      if (at[axis] == 0 || at[axis] + 1 == fine_.size[axis]) on_face |= 1 << axis;
    }
    for (const Simplex& simplex : kSimplices) {
      const int extent = simplex.directions.empty() ? 0 : simplex.directions.back();
      if (extent & blocked) continue;
      const bool whole =
          std::all_of(simplex.directions.begin(), simplex.directions.end(), [&](int d) { return fine_.values[node + offset[d]] >= 0; });
      if (!whole) continue;
      euler_inside_ += simplex.sign;
      if (on_face & ~extent) euler_inside_boundary_ += simplex.sign;
    }
  }
}

}  // namespace smopt::testing
