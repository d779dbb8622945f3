#pragma once

#include <vector>

#include "smopt/surface/scalar_grid.h"

namespace smopt::testing {

/// The trilinear function of a grid, looked at by brute force: sampled on a grid `factor` times as fine, whose cells are cut into six
/// tetrahedra each (Freudenthal). The points of the fine grid with values of one sign, and the simplices between them, have the topology of
/// the set where the function has this sign, if the grid is fine enough. Knows nothing of saddles, deciders or cases.
class SubdividedField {
 public:
  SubdividedField(const ScalarGrid& coarse, int factor);

  /// The connected component of one sign (value >= 0, or < 0) that holds a node of the coarse grid; numbers are different for the two
  /// signs.
  [[nodiscard]] int component_of(std::size_t i, std::size_t j, std::size_t k) const;
  [[nodiscard]] int inside_components() const { return inside_components_; }
  [[nodiscard]] int outside_components() const { return outside_components_; }
  /// Euler characteristic of the level set, whose rim lies in the boundary of the grid: 2·chi(inside) − chi(inside on the boundary).
  [[nodiscard]] int euler_characteristic_of_level_set() const { return 2 * euler_inside_ - euler_inside_boundary_; }

 private:
  void sample(const ScalarGrid& coarse);
  void find_components();
  void flood(std::size_t seed, int label);
  void sum_simplices();

  int factor_;
  ScalarGrid fine_;
  std::vector<int> component_;
  int inside_components_ = 0;
  int outside_components_ = 0;
  int euler_inside_ = 0;
  int euler_inside_boundary_ = 0;
};

}  // namespace smopt::testing
