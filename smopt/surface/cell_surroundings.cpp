#include "smopt/surface/cell_surroundings.h"

#include <bit>
#include <optional>

namespace smopt {
namespace {

/// The node of a level's grid at a corner of a cell.
using Node = std::array<std::int32_t, 3>;

Node node_at(const CellPlace& place, int corner) {
  return {place.at[0] + (corner & 1), place.at[1] + (corner >> 1 & 1), place.at[2] + (corner >> 2)};
}

/// Follows the rule for hanging nodes through the levels.
class NodeValues {
 public:
  explicit NodeValues(CellFinder& finder) : finder_(finder), forest_(finder.forest()) {}

  [[nodiscard]] double at_corner(CellForest::Id id, int corner) const {
    const CellForest::Cell& cell = forest_.cell(id);
    Node node = node_at(cell.place, corner);
    int level = cell.place.level;
    while (level > 0 && odd_axes(node) == 0) {
      for (std::int32_t& coordinate : node) coordinate >>= 1;
      --level;
    }
    if (level == 0) return cell.values[corner];
    return hanging_value(node, level).value_or(cell.values[corner]);
  }

 private:
  static unsigned odd_axes(const Node& node) { return static_cast<unsigned>((node[0] & 1) | (node[1] & 1) << 1 | (node[2] & 1) << 2); }

  /// Of a node that is in the middle of an edge or a face of the next coarser grid, where one of the cells around that is a leaf. Bit a of
  /// `side` tells at which end of the coarser cell the node is on axis a.
  [[nodiscard]] std::optional<double> hanging_value(const Node& node, int level) const {
    const unsigned odd = odd_axes(node);
    if (std::popcount(odd) == 3) return std::nullopt;
    for (unsigned side = 0; side < cube::kCorners; ++side) {
      if ((side & odd) != 0) continue;  // on an odd axis there is one cell, on the others one on each side
      const CellForest::Id id = finder_.find(coarser_cell(node, level, side)).id;
      if (id == CellForest::kNone || !forest_.is_leaf(id)) continue;
      return mean_of_corners(id, side, odd);
    }
    return std::nullopt;
  }

  static CellPlace coarser_cell(const Node& node, int level, unsigned side) {
    CellPlace place{{}, level - 1};
    for (unsigned axis = 0; axis < 3; ++axis) place.at[axis] = (node[axis] >> 1) - static_cast<std::int32_t>(side >> axis & 1U);
    return place;
  }

  /// The corners of the cell at all ends of the odd axes; on the others, `side` tells at which end the node is.
  [[nodiscard]] double mean_of_corners(CellForest::Id id, unsigned side, unsigned odd) const {
    const unsigned first = side & ~odd;
    const unsigned u = odd & (~odd + 1U);
    const unsigned v = odd ^ u;
    const double sum = at_corner(id, static_cast<int>(first)) + at_corner(id, static_cast<int>(first | u));
    if (v == 0) return 0.5 * sum;
    return 0.25 * (sum + (at_corner(id, static_cast<int>(first | v)) + at_corner(id, static_cast<int>(first | u | v))));
  }

  CellFinder& finder_;
  const CellForest& forest_;
};

}  // namespace

CellSurroundings surroundings_of(CellFinder& finder, CellForest::Id leaf) {
  const CellForest& forest = finder.forest();
  const CellPlace& place = forest.cell(leaf).place;
  CellSurroundings around;
  const auto look = [&](const CellPlace& there, unsigned& split, unsigned bits) {
    const CellFinder::Found found = finder.find(there);
    if (found.id == CellForest::kNone) return found;
    if (found.level < place.level)
      around.has_coarser = true;
    else if (!forest.is_leaf(found.id))
      split |= bits;
    return found;
  };
  for (int face = 0; face < cube::kFaces; ++face)
    around.across_face[static_cast<std::size_t>(face)] = look(place_across_face(place, face), around.split_faces, 1U << face);
  for (int edge = 0; edge < cube::kEdges; ++edge) {
    around.across_edge[static_cast<std::size_t>(edge)] = look(place_across_edge(place, edge), around.split_edges, 1U << edge);
    if ((cube::faces_of_edge(edge) & around.split_faces) != 0) around.split_edges |= 1U << edge;
  }
  return around;
}

cube::CornerValues continuous_values(CellFinder& finder, CellForest::Id leaf, const CellSurroundings& around) {
  if (!around.has_coarser) return finder.forest().cell(leaf).values;
  const NodeValues values(finder);
  cube::CornerValues corners;
  for (int corner = 0; corner < cube::kCorners; ++corner) corners[corner] = values.at_corner(leaf, corner);
  return corners;
}

}  // namespace smopt
