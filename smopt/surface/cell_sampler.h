#pragma once

#include <array>
#include <vector>

#include "smopt/surface/cell_forest.h"
#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// The unbounded grids on which the cells of an adaptive partition have their corners.
struct CellLattice {
  /// A cell is judged by samples at half its edge: the finest nodes are this many halvings below the finest cells.
  static constexpr int kHalvingsBelowCells = 1;

  Vec3 origin = Vec3::Zero();  ///< ångström
  double root_edge = 1;        ///< edge of the cells of level 0, ångström
  int finest_level = 0;        ///< no cell is of a higher level

  /// Nodes at `edge / 2^halvings` of the cells of a level.
  [[nodiscard]] ScalarGrid nodes(const CellPlace& first_cell, const std::array<std::int32_t, 3>& cells, int halvings) const;
  [[nodiscard]] double edge(int level) const { return std::ldexp(root_edge, -level); }
};

/// Makes cells with what the partition wants to know of them, from samples of φ.
class CellSampler {
 public:
  CellSampler(const GaussianField& field, double isovalue, const CellLattice& lattice)
      : field_(field), isovalue_(isovalue), lattice_(lattice) {}

  /// All cells of level 0 in a block of them, x fastest.
  [[nodiscard]] std::vector<CellForest::Cell> block_of_roots(const std::array<std::int32_t, 3>& first, std::int32_t edge) const;
  [[nodiscard]] std::array<CellForest::Cell, cube::kCorners> children(const CellPlace& parent) const;

 private:
  [[nodiscard]] CellForest::Cell judged(const CellPlace& place, const ScalarGrid& samples, const std::array<std::size_t, 3>& node) const;

  const GaussianField& field_;
  double isovalue_;
  CellLattice lattice_;
};

}  // namespace smopt
