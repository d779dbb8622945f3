#include "smopt/surface/gaussian_field.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "smopt/error.h"
#include "smopt/parallel.h"
#include "smopt/surface/kernel_adder.h"
#include "smopt/surface/positive_option.h"

namespace smopt {
namespace {

/// Largest exponent d·r² of a kernel: exp(300) = 2e130 leaves room for sums and products of two field values in a double.
constexpr double kLargestExponent = 300;

/// Cubes smaller than the largest reach are looked for in larger ones, of at most so many on an edge.
constexpr double kMostParts = 1024;

void check_options(const GaussianFieldOptions& options) {
  require_positive(options.decay, "decay");
  if (!(options.least_term > 0 && options.least_term < 1))
    throw InvalidOption(fmt::format("the least term must be between 0 and 1, not {}", options.least_term));
}

std::string why_atom_is_invalid(const Vec3& center, double radius, double decay) {
  if (!center.allFinite()) return fmt::format("the position ({}, {}, {}) is not finite", center.x(), center.y(), center.z());
  if (!std::isfinite(radius)) return fmt::format("the radius {} is not finite", radius);
  if (radius < 0) return fmt::format("the radius {} is negative", radius);
  if (decay * radius * radius > kLargestExponent)
    return fmt::format("the radius {} is too large for the decay {}: at most {:.4g}", radius, decay, std::sqrt(kLargestExponent / decay));
  return {};
}

void check_molecule(const Molecule& molecule, double decay) {
  const std::size_t n = molecule.atom_count();
  if (n == 0) throw InvalidInput("the molecule has no atoms");
  if (molecule.radii.size() != n) throw InvalidInput(fmt::format("the molecule has {} atoms and {} radii", n, molecule.radii.size()));
  for (std::size_t i = 0; i < n; ++i) {
    const std::string why = why_atom_is_invalid(molecule.centers[i], molecule.radii[i], decay);
    if (!why.empty()) throw InvalidInput(fmt::format("atom {} of {}: {}", i + 1, n, why));
  }
}

/// Widens what is compared with a sum by more than the sum's rounding.
constexpr double kMargin = 1 + 1e-9;

double squared_distance_to_box(const Vec3& x, const Vec3& low, const Vec3& high) {
  return (x - x.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

/// Whether the cube of half edge `reach` around the centre meets the box.
bool cube_meets_box(const Kernel& kernel, const Vec3& low, const Vec3& high) {
  const double reach = kMargin * kernel.reach;
  return ((kernel.center.array() - reach <= high.array()) && (low.array() <= kernel.center.array() + reach)).all();
}

std::vector<Kernel> kernels_of(const Molecule& molecule, const GaussianFieldOptions& options) {
  std::vector<Kernel> kernels(molecule.atom_count());
  const double squared_reach_of_point = -std::log(options.least_term) / options.decay;
  for_ranges_in_parallel(kernels.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double squared = molecule.radii[i] * molecule.radii[i];
      kernels[i] = {molecule.centers[i], std::exp(options.decay * squared), std::sqrt(squared + squared_reach_of_point)};
    }
  });
  return kernels;
}

using Cube = std::array<std::int32_t, 3>;

/// The cubes of a grid that the cubes around the kernels' reaches meet.
class CubeFinder {
 public:
  CubeFinder(const std::vector<Kernel>& kernels, const Vec3& origin, double edge) : kernels_(kernels), origin_(origin), edge_(edge) {}

  /// In the order z, y, x.
  [[nodiscard]] std::vector<Cube> all() const {
    std::vector<Cube> cubes;
    Cube first{};
    Cube last{};
    for (const Kernel& kernel : kernels_) {
      const Cube previous_first = std::exchange(first, place_of(kernel, -1));
      const Cube previous_last = std::exchange(last, place_of(kernel, 1));
      const bool has_changed = cubes.empty() || first != previous_first || last != previous_last;
      if (has_changed) append_box(first, last, cubes);  // kernels come in spatial order
    }
    sort_zyx(cubes);
    return cubes;
  }

  static void append_box(const Cube& first, const Cube& last, std::vector<Cube>& cubes) {
    for (std::int32_t k = first[2]; k <= last[2]; ++k) {
      for (std::int32_t j = first[1]; j <= last[1]; ++j) {
        for (std::int32_t i = first[0]; i <= last[0]; ++i) cubes.push_back({i, j, k});
      }
    }
  }

  /// Each once.
  static void sort_zyx(std::vector<Cube>& cubes) {
    tbb::parallel_sort(cubes.begin(), cubes.end(),
                       [](const Cube& a, const Cube& b) { return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]); });
    cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  }

 private:
  [[nodiscard]] Cube place_of(const Kernel& kernel, int side) const {
    Cube place{};
    for (int axis = 0; axis < 3; ++axis) {
      const double x = kernel.center[axis] + side * kMargin * kernel.reach;
      place[axis] = static_cast<std::int32_t>(std::floor((x - origin_[axis]) / edge_));
    }
    return place;
  }

  const std::vector<Kernel>& kernels_;
  const Vec3& origin_;
  double edge_;
};

}  // namespace

GaussianField::GaussianField(const Molecule& molecule, const GaussianFieldOptions& options)
    : decay_(options.decay), least_term_(options.least_term) {
  check_options(options);
  check_molecule(molecule, options.decay);
  kernels_ = KernelRows(kernels_of(molecule, options));
  low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (const Kernel& kernel : kernels()) {
    low_ = low_.cwiseMin(kernel.center - Vec3::Constant(kernel.reach));
    high_ = high_.cwiseMax(kernel.center + Vec3::Constant(kernel.reach));
  }
}

std::vector<Cube> GaussianField::reached_cubes(const Vec3& origin, double edge) const {
  const Vec3 farthest = (low_ - origin).cwiseAbs().cwiseMax((high_ - origin).cwiseAbs()) / edge;
  if (!(farthest.maxCoeff() + 2 * kMostParts < std::numeric_limits<std::int32_t>::max()))
    throw InvalidInput(fmt::format("the molecule is too large for blocks of {:.3g} Å: {:.6g} Å", edge, (high_ - low_).maxCoeff()));

  const auto parts = static_cast<std::int32_t>(std::min(kMostParts, std::ceil(kernels_.largest_reach() / edge)));
  const std::vector<Cube> coarse = CubeFinder(kernels(), origin, parts * edge).all();
  if (parts == 1) return coarse;
  std::vector<Cube> cubes;
  std::vector<Cube> inside;
  for (const auto& [i, j, k] : coarse) {
    inside.clear();
    CubeFinder::append_box({parts * i, parts * j, parts * k}, {parts * i + parts - 1, parts * j + parts - 1, parts * k + parts - 1},
                           inside);
    for (const Cube& cube : inside) {
      const Vec3 low = origin + edge * Vec3(cube[0], cube[1], cube[2]);
      if (reaches(low, low + Vec3::Constant(edge))) cubes.push_back(cube);
    }
  }
  CubeFinder::sort_zyx(cubes);
  return cubes;
}

bool GaussianField::reaches(const Vec3& low, const Vec3& high) const {
  bool found = false;
  kernels_.visit_near_box(low, high, [&](const Kernel& kernel) {
    found = cube_meets_box(kernel, low, high);
    return !found;
  });
  return found;
}

bool GaussianField::may_reach(double value, const Vec3& low, const Vec3& high) const {
  double sum = 0;
  kernels_.visit_near_box(low, high, [&](const Kernel& kernel) {
    if (cube_meets_box(kernel, low, high))
      sum += kMargin * kernel.amplitude * std::exp(-decay_ * squared_distance_to_box(kernel.center, low, high));
    return sum < value;
  });
  return sum >= value;
}

double GaussianField::value(const Vec3& x) const {
  double sum = 0;
  kernels_.visit_near_point(x, [&](const Kernel& kernel) {
    const double squared_distance = (x - kernel.center).squaredNorm();
    if (squared_distance <= kernel.reach * kernel.reach) sum += kernel.amplitude * std::exp(-decay_ * squared_distance);
    return true;
  });
  return sum;
}

FieldJet GaussianField::jet(const Vec3& x) const {
  FieldJet jet;
  kernels_.visit_near_point(x, [&](const Kernel& kernel) {
    const Vec3 away = x - kernel.center;
    const double squared_distance = away.squaredNorm();
    if (squared_distance > kernel.reach * kernel.reach) return true;
    const double term = kernel.amplitude * std::exp(-decay_ * squared_distance);
    const Vec3 weighted = term * away;
    jet.value += term;
    jet.gradient += weighted;
    jet.hessian += weighted * away.transpose();
    return true;
  });
  jet.hessian = 4 * decay_ * decay_ * jet.hessian - 2 * decay_ * jet.value * Eigen::Matrix3d::Identity();
  jet.gradient *= -2 * decay_;
  return jet;
}

void GaussianField::sample(ScalarGrid& grid, SampleBits bits) const {
  grid.values.assign(grid.node_count(), 0.0);
  if (grid.values.empty()) return;
  Vec3 low;
  Vec3 high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = grid.coordinate(axis, 0);
    high[axis] = grid.coordinate(axis, grid.size[axis] - 1);
  }
  KernelAdder adder(grid, decay_, least_term_, kernels_.largest_reach(), bits);
  kernels_.visit_near_box(low, high, [&](const Kernel& kernel) {
    adder.add(kernel);
    return true;
  });
}

}  // namespace smopt
