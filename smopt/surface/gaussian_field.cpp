#include "smopt/surface/gaussian_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "smopt/error.h"

namespace smopt {
namespace {

/// Largest exponent d·r² of a kernel: exp(300) = 2e130 leaves room for sums and products of two field values in a double.
constexpr double kLargestExponent = 300;

/// Bits of a bin's place on an axis: 2 097 152 bins of half a reach (some 2.5 Å) are five million ångström.
constexpr int kPlaceBits = 21;
constexpr std::int64_t kMostPlaces = std::int64_t{1} << kPlaceBits;

void check_options(const GaussianFieldOptions& options) {
  if (!(std::isfinite(options.decay) && options.decay > 0))
    throw InvalidOption(fmt::format("decay must be positive and finite, not {}", options.decay));
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

/// Widens a reach by more than its rounding, so that a block never misses an atom that another block with the same node has.
constexpr double kReachMargin = 1 + 1e-9;

/// Whether the cube of half edge `reach` around the centre meets the box.
bool cube_meets_box(const Vec3& center, double reach, const Vec3& low, const Vec3& high) {
  return ((center.array() - reach <= high.array()) && (low.array() <= center.array() + reach)).all();
}

/// One kernel on one axis: exp(-d·(x - center)²) at the nodes from `first` on.
struct Profile {
  std::size_t first = 0;
  std::vector<double> values;
};

/// Adds kernels to the nodes of a block one after another. Which node gets a kernel depends on the node and the atom alone, not on the block.
class KernelAdder {
 public:
  KernelAdder(ScalarGrid& grid, double decay, double least_term) : grid_(grid), decay_(decay), least_term_(least_term) {}

  void add(const Vec3& center, double amplitude, double reach) {
    for (int axis = 0; axis < 3; ++axis) sample_profile(axis, center[axis], reach, profiles_[axis]);
    const auto& [x, y, z] = profiles_;
    if (x.values.empty()) return;
    for (std::size_t k = 0; k < z.values.size(); ++k) {
      for (std::size_t j = 0; j < y.values.size(); ++j) {
        const double factor = amplitude * z.values[k] * y.values[j];
        if (factor >= least_term_) add_row(x, factor, &grid_.values[grid_.index(x.first, y.first + j, z.first + k)]);
      }
    }
  }

 private:
  void sample_profile(int axis, double center, double reach, Profile& profile) const {
    const double offset = grid_.first[axis];
    const double first = std::max(0.0, std::ceil((center - reach - grid_.origin[axis]) / grid_.spacing) - offset);
    const double last = std::min(grid_.size[axis] - 1.0, std::floor((center + reach - grid_.origin[axis]) / grid_.spacing) - offset);
    profile.values.clear();
    if (!(first <= last)) return;
    profile.first = static_cast<std::size_t>(first);
    for (std::size_t i = profile.first; i <= static_cast<std::size_t>(last); ++i) {
      const double distance = grid_.coordinate(axis, i) - center;
      profile.values.push_back(std::exp(-decay_ * distance * distance));
    }
  }

  static void add_row(const Profile& x, double factor, double* row) {
    for (std::size_t i = 0; i < x.values.size(); ++i) row[i] += factor * x.values[i];
  }

  ScalarGrid& grid_;
  double decay_;
  double least_term_;
  std::array<Profile, 3> profiles_;
};

}  // namespace

GaussianField::GaussianField(const Molecule& molecule, const GaussianFieldOptions& options)
    : decay_(options.decay), least_term_(options.least_term) {
  check_options(options);
  check_molecule(molecule, options.decay);
  const std::size_t n = molecule.atom_count();
  std::vector<Atom> atoms(n);
  low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (std::size_t i = 0; i < n; ++i) {
    const double squared = molecule.radii[i] * molecule.radii[i];
    const double reach = std::sqrt(squared - std::log(least_term_) / decay_);
    atoms[i] = {molecule.centers[i], std::exp(decay_ * squared), reach};
    low_ = low_.cwiseMin(atoms[i].center - Vec3::Constant(reach));
    high_ = high_.cwiseMax(atoms[i].center + Vec3::Constant(reach));
    largest_reach_ = std::max(largest_reach_, reach);
  }
  bin_edge_ = std::max(0.5 * largest_reach_, (high_ - low_).maxCoeff() / static_cast<double>(kMostPlaces - 1));

  std::vector<std::uint64_t> bin(n);
  for (std::size_t i = 0; i < n; ++i) bin[i] = bin_of(place_of(atoms[i].center));
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return bin[a] < bin[b]; });
  atoms_.reserve(n);
  bins_.reserve(n);
  for (const std::uint32_t i : order) {
    atoms_.push_back(atoms[i]);
    bins_.push_back(bin[i]);
  }
}

std::array<std::int64_t, 3> GaussianField::place_of(const Vec3& x) const {
  std::array<std::int64_t, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor((x[axis] - low_[axis]) / bin_edge_);
    at[axis] = static_cast<std::int64_t>(std::clamp(place, 0.0, static_cast<double>(kMostPlaces - 1)));
  }
  return at;
}

std::uint64_t GaussianField::bin_of(const std::array<std::int64_t, 3>& at) const {
  return static_cast<std::uint64_t>((at[2] << (2 * kPlaceBits)) | (at[1] << kPlaceBits) | at[0]);
}

/// Visits the atoms whose cube of half edge `reach` meets the box, in the order of `atoms_`; `visit` returns whether to go on.
template <class Visit>
void GaussianField::for_atoms_near(const Vec3& low, const Vec3& high, const Visit& visit) const {
  const Vec3 around = Vec3::Constant(kReachMargin * largest_reach_);
  const auto first = place_of(low - around);
  const auto last = place_of(high + around);
  for (std::int64_t k = first[2]; k <= last[2]; ++k) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      const auto begin = std::lower_bound(bins_.begin(), bins_.end(), bin_of({first[0], j, k})) - bins_.begin();
      const std::uint64_t last_bin = bin_of({last[0], j, k});
      for (auto i = static_cast<std::size_t>(begin); i < atoms_.size() && bins_[i] <= last_bin; ++i) {
        const Atom& atom = atoms_[i];
        if (cube_meets_box(atom.center, kReachMargin * atom.reach, low, high) && !visit(atom)) return;
      }
    }
  }
}

std::vector<std::array<std::int32_t, 3>> GaussianField::reached_cubes(const Vec3& origin, double edge) const {
  const auto place = [&](double x, int axis) {
    const double at = std::floor((x - origin[axis]) / edge);
    if (!(std::abs(at) < std::numeric_limits<std::int32_t>::max()))
      throw InvalidInput(fmt::format("the molecule is too large for blocks of {:.3g} Å: {:.6g} Å", edge, (high_ - low_).maxCoeff()));
    return static_cast<std::int32_t>(at);
  };
  std::vector<std::array<std::int32_t, 3>> cubes;  // z, y, x while they are sorted
  std::array<std::int32_t, 3> previous_first{};
  std::array<std::int32_t, 3> previous_last{};
  for (const Atom& atom : atoms_) {
    std::array<std::int32_t, 3> first{};
    std::array<std::int32_t, 3> last{};
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = place(atom.center[axis] - kReachMargin * atom.reach, axis);
      last[axis] = place(atom.center[axis] + kReachMargin * atom.reach, axis);
    }
    if (!cubes.empty() && first == previous_first && last == previous_last) continue;  // atoms come in spatial order
    previous_first = first;
    previous_last = last;
    for (std::int32_t k = first[2]; k <= last[2]; ++k) {
      for (std::int32_t j = first[1]; j <= last[1]; ++j) {
        for (std::int32_t i = first[0]; i <= last[0]; ++i) cubes.push_back({k, j, i});
      }
    }
  }
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  for (auto& cube : cubes) std::swap(cube[0], cube[2]);
  return cubes;
}

bool GaussianField::reaches(const Vec3& low, const Vec3& high) const {
  bool found = false;
  for_atoms_near(low, high, [&](const Atom&) {
    found = true;
    return false;
  });
  return found;
}

double GaussianField::value(const Vec3& x) const {
  double sum = 0;
  for_atoms_near(x, x, [&](const Atom& atom) {
    const double squared_distance = (x - atom.center).squaredNorm();
    if (squared_distance <= atom.reach * atom.reach) sum += atom.amplitude * std::exp(-decay_ * squared_distance);
    return true;
  });
  return sum;
}

FieldJet GaussianField::jet(const Vec3& x) const {
  FieldJet jet;
  for_atoms_near(x, x, [&](const Atom& atom) {
    const Vec3 away = x - atom.center;
    if (away.squaredNorm() > atom.reach * atom.reach) return true;
    const double term = atom.amplitude * std::exp(-decay_ * away.squaredNorm());
    jet.value += term;
    jet.gradient += term * away;
    jet.hessian += term * away * away.transpose();
    return true;
  });
  jet.hessian = 4 * decay_ * decay_ * jet.hessian - 2 * decay_ * jet.value * Eigen::Matrix3d::Identity();
  jet.gradient *= -2 * decay_;
  return jet;
}

void GaussianField::sample(ScalarGrid& grid) const {
  grid.values.assign(grid.node_count(), 0.0);
  if (grid.values.empty()) return;
  Vec3 low;
  Vec3 high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = grid.coordinate(axis, 0);
    high[axis] = grid.coordinate(axis, grid.size[axis] - 1);
  }
  KernelAdder adder(grid, decay_, least_term_);
  for_atoms_near(low, high, [&](const Atom& atom) {
    adder.add(atom.center, atom.amplitude, atom.reach);
    return true;
  });
}

}  // namespace smopt
