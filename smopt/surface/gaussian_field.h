#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"
#include "smopt/io/molecule.h"
#include "smopt/surface/kernel_adder.h"
#include "smopt/surface/kernel_rows.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt {

/// The parameters of the kernel sum.
struct GaussianFieldOptions {
  double decay = 0.6;        ///< d of the kernel, 1/Å²; > 0
  double least_term = 1e-6;  ///< a kernel's value below which it may be left out; in (0, 1)
};

/// φ, its gradient and its matrix of second derivatives at a point.
struct FieldJet {
  double value = 0;
  Vec3 gradient = Vec3::Zero();                       ///< 1/Å
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();  ///< 1/Å²
};

/// The Gaussian field of a molecule, φ(x) = Σ exp(-d(|x - x_i|² - r_i²)) (Liu et al. 2017, equations 1 and 2).
///
/// Terms below `least_term` are left out: at the density of atoms in a protein (0.1 per Å³) all that is left out at a point sums up to less
/// than ten times the least term. The memory is that of the atoms (90 bytes each, twice as much while it is built),
/// however large the box around them is. Immutable, so that any number of threads may ask at once.
class GaussianField {
 public:
  /// \throws InvalidInput for a molecule without atoms, a negative or non-finite radius or coordinate, or a radius for which the kernel
  /// overflows.
  /// \throws InvalidOption for an option out of its range.
  /// Cost: O(atoms·log atoms).
  GaussianField(const Molecule& molecule, const GaussianFieldOptions& options);

  [[nodiscard]] std::size_t atom_count() const { return kernels_.kernels().size(); }
  [[nodiscard]] double decay() const { return decay_; }
  /// In an order of their own.
  [[nodiscard]] const std::vector<Kernel>& kernels() const { return kernels_.kernels(); }
  /// The box outside of which φ is zero.
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] const Vec3& high() const { return high_; }

  /// The cubes of a grid of cubes that some kernel may reach (taken as a cube), in the order z, y, x: cube (i, j, k) spans origin + edge·(i, j, k) to
  /// origin + edge·(i + 1, j + 1, k + 1).
  /// \throws InvalidInput when their numbers do not fit 32 bits.
  /// Cost: O(n·log n + c·a) for n atoms, c cubes in and around the molecule and the a atoms near each.
  [[nodiscard]] std::vector<std::array<std::int32_t, 3>> reached_cubes(const Vec3& origin, double edge) const;

  /// Whether φ may be other than zero somewhere in the closed box.
  [[nodiscard]] bool reaches(const Vec3& low, const Vec3& high) const;

  /// Whether φ may reach a value > 0 somewhere in the closed box: false is certain (for `sample`, too), and true when the kernels' largest
  /// values in the box sum up to as much. Cost: the atoms within reach, fewer the sooner they do.
  [[nodiscard]] bool may_reach(double value, const Vec3& low, const Vec3& high) const;

  /// Cost: the atoms within reach.
  [[nodiscard]] double value(const Vec3& x) const;
  [[nodiscard]] FieldJet jet(const Vec3& x) const;

  /// Fills grid.values with φ at the nodes (see `KernelAdder`). The value of a node has the same bits in every block of the same unbounded
  /// grid, and with `SampleBits::of_position` in every grid that has a node just there.
  /// Cost: O(nodes + atoms within reach × nodes within the reach of each).
  void sample(ScalarGrid& grid, SampleBits bits = SampleBits::of_grid) const;

 private:
  double decay_;
  double least_term_;
  Vec3 low_;
  Vec3 high_;
  KernelRows kernels_;
};

}  // namespace smopt
