#include "smopt/surface/gaussian_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace smopt {
namespace {

/// More nodes than this are refused (16 GiB of values): a spacing that is far too small, or an atom that is far away.
constexpr double kMostNodes = 2147483648.0;

/// Largest exponent d·r² of a kernel: exp(300) = 2e130 leaves room for sums and products of two field values in a double.
constexpr double kLargestExponent = 300;

/// Progress is reported once in so many atoms.
constexpr std::size_t kAtomsPerReport = 4096;

void require_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0)) throw InvalidOption(fmt::format("{} must be positive and finite, not {}", name, value));
}

void check_options(const GaussianGridOptions& options) {
  require_positive(options.decay, "decay");
  require_positive(options.spacing, "spacing");
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

/// Samples the kernels of a checked molecule one after another.
class FieldSampler {
 public:
  FieldSampler(const Molecule& molecule, const GaussianGridOptions& options) : molecule_(molecule), options_(options) { lay_out_grid(); }

  ScalarGrid run(const ProgressCallback& progress) {
    grid_.values.assign(grid_.node_count(), 0.0);
    const std::size_t n = molecule_.atom_count();
    for (std::size_t atom = 0; atom < n; ++atom) {
      if (atom % kAtomsPerReport == 0) report_progress(progress, "field", static_cast<double>(atom) / static_cast<double>(n));
      add_kernel(molecule_.centers[atom], molecule_.radii[atom]);
    }
    return std::move(grid_);
  }

 private:
  /// One kernel on one axis: exp(-d·(x - center)²) at the nodes from `first` on.
  struct Profile {
    std::size_t first = 0;
    std::vector<double> values;
  };

  /// The distance at which a kernel has fallen to the least term.
  [[nodiscard]] double reach(double radius) const { return std::sqrt(radius * radius - std::log(options_.least_term) / options_.decay); }

  void lay_out_grid() {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (std::size_t i = 0; i < molecule_.atom_count(); ++i) {
      const Vec3 around = Vec3::Constant(reach(molecule_.radii[i]));
      low = low.cwiseMin(molecule_.centers[i] - around);
      high = high.cwiseMax(molecule_.centers[i] + around);
    }
    grid_.spacing = options_.spacing;
    grid_.origin = low - Vec3::Constant(options_.spacing);  // one layer of zeros below, and at least one above
    const Vec3 nodes = ((high - grid_.origin) / options_.spacing).array().ceil() + 2;
    if (!(nodes.prod() <= kMostNodes)) {
      throw InvalidInput(fmt::format("the grid would have {:.0f} x {:.0f} x {:.0f} nodes at a spacing of {}: more than 2^31", nodes.x(),
                                     nodes.y(), nodes.z(), options_.spacing));
    }
    for (int axis = 0; axis < 3; ++axis) grid_.size[axis] = static_cast<std::uint32_t>(nodes[axis]);
  }

  void sample_profile(int axis, double center, double reach, Profile& profile) const {
    const double innermost = grid_.size[axis] - 2.0;
    const double first = std::max(1.0, std::ceil((center - reach - grid_.origin[axis]) / grid_.spacing));
    const double last = std::min(innermost, std::floor((center + reach - grid_.origin[axis]) / grid_.spacing));
    profile.first = static_cast<std::size_t>(first);
    profile.values.clear();
    for (std::size_t i = profile.first; i <= static_cast<std::size_t>(std::max(0.0, last)); ++i) {
      const double distance = grid_.coordinate(axis, i) - center;
      profile.values.push_back(std::exp(-options_.decay * distance * distance));
    }
  }

  void add_kernel(const Vec3& center, double radius) {
    const double amplitude = std::exp(options_.decay * radius * radius);
    for (int axis = 0; axis < 3; ++axis) sample_profile(axis, center[axis], reach(radius), profiles_[axis]);
    const auto& [x, y, z] = profiles_;
    for (std::size_t k = 0; k < z.values.size(); ++k) {
      for (std::size_t j = 0; j < y.values.size(); ++j) {
        const double factor = amplitude * z.values[k] * y.values[j];
        if (factor >= options_.least_term) add_row(x, factor, &grid_.values[grid_.index(x.first, y.first + j, z.first + k)]);
      }
    }
  }

  static void add_row(const Profile& x, double factor, double* row) {
    for (std::size_t i = 0; i < x.values.size(); ++i) row[i] += factor * x.values[i];
  }

  const Molecule& molecule_;
  const GaussianGridOptions& options_;
  ScalarGrid grid_;
  std::array<Profile, 3> profiles_;
};

}  // namespace

ScalarGrid gaussian_grid(const Molecule& molecule, const GaussianGridOptions& options, const ProgressCallback& progress) {
  check_options(options);
  check_molecule(molecule, options.decay);
  return FieldSampler(molecule, options).run(progress);
}

}  // namespace smopt
