#include "smopt/surface/kernel_adder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace smopt {
namespace {

/// Where the exponent at a spacing beyond the reach is larger than this, factors could leave the range of a double (exp(±708)).
constexpr double kSteepestExponent = 600;

/// Two doubles that are worked on at once (the compiler's vector extension).
using Pair = double __attribute__((vector_size(16)));

void add_row(const double* x, std::size_t count, double factor, double* row) {
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) {
    Pair sum;
    Pair values;
    std::memcpy(&sum, row + i, sizeof sum);
    std::memcpy(&values, x + i, sizeof values);
    sum += factor * values;
    std::memcpy(row + i, &sum, sizeof sum);
  }
  if (i < count) row[i] += factor * x[i];
}

double squared(double x) {
  return x * x;
}

/// Where the values on one side of a node go.
struct Side {
  double* values;
  std::ptrdiff_t middle;  ///< the node's number, perhaps not one of the values'
  std::ptrdiff_t step;    ///< 1 or -1
};

/// The profile at the nodes `from` to `to` steps away from the one where it is `at_middle`. \param falls  exp(-d(kh)²) for k = 0, 1, …
void step_outwards(double at_middle, double ratio, std::ptrdiff_t from, std::ptrdiff_t to, const std::vector<double>& falls,
                   const Side& side) {
  double power = at_middle;
  for (std::ptrdiff_t k = 0; k < from && from <= to; ++k) power *= ratio;
  for (std::ptrdiff_t k = from; k <= to; ++k) {
    side.values[side.middle + k * side.step] = power * falls[static_cast<std::size_t>(k)];
    power *= ratio;
  }
}

}  // namespace

KernelAdder::KernelAdder(ScalarGrid& grid, double decay, double least_term, double largest_reach, SampleBits bits)
    : grid_(grid), decay_(decay), least_term_(least_term), bits_(bits) {
  for (int axis = 0; axis < 3; ++axis) profiles_[axis].values.resize(grid.size[axis]);
  if (bits == SampleBits::of_position) return;
  const double steps = std::ceil(largest_reach / grid.spacing) + 2;  // the nearest node is up to half a spacing from the centre
  falls_.reserve(static_cast<std::size_t>(steps));
  for (double k = 0; k < steps; ++k) falls_.push_back(std::exp(-decay * squared(k * grid.spacing)));
}

void KernelAdder::add(const Kernel& kernel) {
  for (int axis = 0; axis < 3; ++axis)
    if (!sample_profile(axis, kernel)) return;
  const auto& [x, y, z] = profiles_;
  for (std::size_t k = 0; k < z.count; ++k) {
    const double slice = kernel.amplitude * z.values[k];
    double* row = &grid_.values[grid_.index(x.first, y.first, z.first + k)];
    for (std::size_t j = 0; j < y.count; ++j, row += grid_.size[0]) {
      const double factor = slice * y.values[j];
      if (factor >= least_term_) add_row(x.values.data(), x.count, factor, row);
    }
  }
}

/// Returns whether there is a node of the block within reach on this axis.
bool KernelAdder::sample_profile(int axis, const Kernel& kernel) {
  const double h = grid_.spacing;
  const double center = kernel.center[axis];
  const double offset = grid_.first[axis];
  const double first = std::max(offset, std::ceil((center - kernel.reach - grid_.origin[axis]) / h));
  const double last = std::min(offset + grid_.size[axis] - 1, std::floor((center + kernel.reach - grid_.origin[axis]) / h));
  if (!(first <= last)) return false;
  Profile& profile = profiles_[axis];
  profile.first = static_cast<std::size_t>(first - offset);
  profile.count = static_cast<std::size_t>(last - first) + 1;
  if (bits_ == SampleBits::of_position || decay_ * squared(kernel.reach + h) > kSteepestExponent) {
    sample_node_by_node(axis, kernel, profile);
    return true;
  }
  const double nearest = std::floor((center - grid_.origin[axis]) / h + 0.5);
  const double x = grid_.origin[axis] + h * nearest - center;
  const double ratio = std::exp(-2 * decay_ * x * h);
  const double at_nearest = std::exp(-decay_ * x * x);
  const auto middle = static_cast<std::ptrdiff_t>(nearest - first);  // may lie outside of the block
  const auto end = static_cast<std::ptrdiff_t>(profile.count) - 1;
  step_outwards(at_nearest, ratio, std::max<std::ptrdiff_t>(0, -middle), end - middle, falls_, {profile.values.data(), middle, 1});
  step_outwards(at_nearest, 1 / ratio, std::max<std::ptrdiff_t>(1, middle - end), middle, falls_, {profile.values.data(), middle, -1});
  return true;
}

void KernelAdder::sample_node_by_node(int axis, const Kernel& kernel, Profile& profile) const {
  for (std::size_t i = 0; i < profile.count; ++i) {
    const double x = grid_.coordinate(axis, profile.first + i) - kernel.center[axis];
    profile.values[i] = std::exp(-decay_ * squared(x));
  }
}

}  // namespace smopt
