#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "smopt/surface/kernel_rows.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt {

/// On what the bits of a node's value depend, apart from the kernels.
enum class SampleBits {
  of_grid,     ///< on the unbounded grid and the node: two exponentials an axis
  of_position  ///< on the node's position alone, so that grids of different spacing agree where they have a node in common: one a node
};

/// Adds Gaussian kernels exp(-d·|x - center|²)·amplitude to the nodes of a block, one after another.
///
/// A kernel is separable: a profile on each axis, then products. A profile starts at the node nearest to the centre, with one exponential,
/// and goes on outwards by factors: exp(-d(x + kh)²) = exp(-d·x²)·exp(-2dxh)ᵏ·exp(-d(kh)²); that takes two exponentials an axis instead
/// of one a node, and is right to a few hundred rounding errors. Which nodes get a kernel (those of a cylinder along x with its reach for
/// radius and half length), and the bits that they get, depend on node and kernel alone, and not on the block.
class KernelAdder {
 public:
  /// \param largest_reach  of all kernels that will be added, ångström.
  KernelAdder(ScalarGrid& grid, double decay, double least_term, double largest_reach, SampleBits bits);

  /// Cost: the nodes within reach.
  void add(const Kernel& kernel);

 private:
  /// One kernel on one axis, at the nodes of the block from `first` on.
  struct Profile {
    std::size_t first = 0;
    std::size_t count = 0;
    std::vector<double> values;  ///< room for all nodes of the block on this axis
  };

  bool sample_profile(int axis, const Kernel& kernel);
  void sample_node_by_node(int axis, const Kernel& kernel, Profile& profile) const;

  ScalarGrid& grid_;
  double decay_;
  double least_term_;
  SampleBits bits_;
  std::vector<double> falls_;  // exp(-d(kh)²)
  std::array<Profile, 3> profiles_;
};

}  // namespace smopt
