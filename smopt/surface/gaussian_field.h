#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"
#include "smopt/io/molecule.h"
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
/// than ten times the least term. Atoms are found by a grid of neighbours that takes memory for atoms only, however large the box around
/// them is. Immutable, so that any number of threads may ask at once.
class GaussianField {
 public:
  /// \throws InvalidInput for a molecule without atoms, a negative or non-finite radius or coordinate, or a radius for which the kernel
  /// overflows.
  /// \throws InvalidOption for an option out of its range.
  /// Cost: O(atoms·log atoms).
  GaussianField(const Molecule& molecule, const GaussianFieldOptions& options);

  [[nodiscard]] std::size_t atom_count() const { return atoms_.size(); }
  [[nodiscard]] double decay() const { return decay_; }
  /// The box outside of which φ is zero.
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] const Vec3& high() const { return high_; }

  /// The cubes of a grid of cubes that some kernel reaches, in the order z, y, x: cube (i, j, k) spans origin + edge·(i, j, k) to
  /// origin + edge·(i + 1, j + 1, k + 1).
  /// \throws InvalidInput when their numbers do not fit 32 bits.
  /// Cost: O(b·log b) for b pairs of an atom and a cube that it reaches.
  [[nodiscard]] std::vector<std::array<std::int32_t, 3>> reached_cubes(const Vec3& origin, double edge) const;

  /// Whether φ may be other than zero somewhere in the closed box.
  [[nodiscard]] bool reaches(const Vec3& low, const Vec3& high) const;

  /// Cost: the atoms within reach.
  [[nodiscard]] double value(const Vec3& x) const;
  [[nodiscard]] FieldJet jet(const Vec3& x) const;

  /// Fills grid.values with φ at the nodes. A kernel is separable: three one-dimensional exponentials an atom, then products. The value of
  /// a node has the same bits in every block of the same unbounded grid.
  /// Cost: O(nodes + atoms within reach × nodes within the reach of each).
  void sample(ScalarGrid& grid) const;

 private:
  struct Atom {
    Vec3 center;
    double amplitude;  ///< exp(d·r²)
    double reach;      ///< distance at which the kernel has fallen to the least term
  };

  template <class Visit>
  void for_atoms_near(const Vec3& low, const Vec3& high, const Visit& visit) const;
  [[nodiscard]] std::uint64_t bin_of(const std::array<std::int64_t, 3>& at) const;
  [[nodiscard]] std::array<std::int64_t, 3> place_of(const Vec3& x) const;

  double decay_;
  double least_term_;
  double largest_reach_ = 0;
  double bin_edge_ = 1;
  Vec3 low_;
  Vec3 high_;
  std::vector<Atom> atoms_;          ///< in the order of their bins, and within a bin in that of the molecule
  std::vector<std::uint64_t> bins_;  ///< of the atoms; ascending
};

}  // namespace smopt
