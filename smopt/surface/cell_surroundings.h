#pragma once

#include <array>

#include "smopt/surface/cell_forest.h"

namespace smopt {

/// The cells across the faces and edges of a leaf: of its own level, or the coarser leaf that covers the place, or none.
struct CellSurroundings {
  std::array<CellFinder::Found, cube::kFaces> across_face{};
  std::array<CellFinder::Found, cube::kEdges> across_edge{};
  unsigned split_faces = 0;  ///< bits: faces behind which the cells are smaller
  unsigned split_edges = 0;  ///< bits: edges that smaller cells have in two halves
  bool has_coarser = false;  ///< one of the cells is of a lower level
};

/// The place across a face or an edge.
inline CellPlace place_across_face(const CellPlace& place, int face) {
  CellPlace other = place;
  other.at[static_cast<std::size_t>(face / 2)] += face % 2 == 1 ? 1 : -1;
  return other;
}

inline CellPlace place_across_edge(const CellPlace& place, int edge) {
  const int axis = cube::axis_of_edge(edge);
  CellPlace other = place;
  other.at[static_cast<std::size_t>((axis + 1) % 3)] += (edge & 1) != 0 ? 1 : -1;
  other.at[static_cast<std::size_t>((axis + 2) % 3)] += (edge >> 1 & 1) != 0 ? 1 : -1;
  return other;
}

CellSurroundings surroundings_of(CellFinder& finder, CellForest::Id leaf);

/// Values at the corners of a leaf that make the interpolant continuous over the whole partition: a corner in the middle of a coarser leaf's
/// edge or face has the mean of that edge's or face's ends instead of its own value.
/// \pre cells that share a face or an edge differ by one level at most.
cube::CornerValues continuous_values(CellFinder& finder, CellForest::Id leaf, const CellSurroundings& around);

}  // namespace smopt
