#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "smopt/surface/cube.h"
#include "smopt/surface/place_map.h"

namespace smopt {

/// Where a cube of an adaptive partition is: cubes of level l have the edge h / 2^l, and cube `at` spans at … at + 1 in units of it.
struct CellPlace {
  std::array<std::int32_t, 3> at{};
  int level = 0;

  [[nodiscard]] CellPlace child(int corner) const {
    return {{2 * at[0] + (corner & 1), 2 * at[1] + (corner >> 1 & 1), 2 * at[2] + (corner >> 2)}, level + 1};
  }
  [[nodiscard]] CellPlace parent() const { return {{at[0] >> 1, at[1] >> 1, at[2] >> 1}, level - 1}; }
  [[nodiscard]] bool is_first_child() const { return ((at[0] | at[1] | at[2]) & 1) == 0; }
};

/// The cubes of an adaptive partition: roots of level 0, kept where there is something to say about them, each the top of an octree.
class CellForest {
 public:
  using Id = std::int32_t;
  static constexpr Id kNone = -1;

  struct Cell {
    CellPlace place;
    float error = 0;              ///< largest |φ − interpolant| in the cell, estimated
    float slope = 0;              ///< least |∇φ| in the cell, estimated, 1/Å; 0 where φ may be flat
    cube::CornerValues values{};  ///< φ − c at the corners
    /// Bits: axes along which φ grows wherever φ = c may pass in the cell (0 to 2), and along which it falls (3 to 5); estimated.
    std::uint8_t monotone_axes = 0;
    bool may_be_crossed = false;  ///< φ = c may pass through the cell
  };

  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const Cell& cell(Id id) const { return cells_[id]; }
  [[nodiscard]] bool is_leaf(Id id) const { return first_child_[id] == kNone; }
  /// Of the eight children, which follow each other in the order of the cube's corners.
  [[nodiscard]] Id first_child(Id id) const { return first_child_[id]; }
  /// Memory of a cell and of what is kept about it: vectors may be half full.
  [[nodiscard]] static constexpr double bytes_per_cell() { return 2 * (sizeof(Cell) + sizeof(Id)); }
  /// The cell at this place, or the leaf it would lie in; kNone where no root is kept. See `CellFinder` for many that are near each other.
  [[nodiscard]] Id find(const CellPlace& place) const;

  /// \pre there is no such root; its level is 0.
  void add_root(const Cell& cell);
  /// \pre the cell is a leaf; the children are at its eight parts.
  void add_children(Id parent, const std::array<Cell, cube::kCorners>& children);

 private:
  std::vector<Cell> cells_;
  std::vector<Id> first_child_;  ///< apart from the cells: the way down a tree touches nothing else
  PlaceMap<3> roots_;

  friend class CellFinder;
};

/// Finds cells that are near each other: the 27 roots about the one that was asked for last are remembered. One for each thread; the forest must
/// outlive it, and not grow meanwhile.
class CellFinder {
 public:
  explicit CellFinder(const CellForest& forest) : forest_(forest) {}

  [[nodiscard]] const CellForest& forest() const { return forest_; }
  /// A cell and its level, which is known from the way to it.
  struct Found {
    CellForest::Id id = CellForest::kNone;
    int level = 0;
  };
  /// As `CellForest::find`. Cost: O(level) as long as the places stay near each other.
  [[nodiscard]] Found find(const CellPlace& place);

 private:
  using Root = std::array<std::int32_t, 3>;
  void remember_roots_about(const Root& root);

  const CellForest& forest_;
  Root middle_ = {std::numeric_limits<std::int32_t>::min() / 2, 0, 0};  // of none yet; its neighbours are numbers too
  std::array<CellForest::Id, 27> roots_{};
};

}  // namespace smopt
