#pragma once

#include <array>
#include <optional>
#include <vector>

#include "smopt/surface/cell_tunnel.h"
#include "smopt/surface/patch_embedding.h"

namespace smopt {

/// The triangles of the level set in one cell. Points 0 to 11 are those on the cube's edges, the others lie inside the cell.
struct CellPatch {
  static constexpr int kMaxPoints = cube::kEdges + 6;  ///< the most inside are those of a tunnel's waist

  std::vector<Vec3> points;
  std::vector<PatchTriangle> triangles;

  [[nodiscard]] std::size_t interior_points() const { return points.size() - cube::kEdges; }
};

/// Fills a cell's loops with triangles: a disc for each loop, one annulus for the two loops of a tunnel.
///
/// The triangles of a cell meet its cube's boundary in the loops alone and each other in shared corners and edges alone, so the union
/// over all cells is embedded. What is chosen, among the triangulations for which that holds, has the least area:
/// - a loop in a cell without ambiguous face: the best fan. Every fan will do: the projection from a corner of the loop onto the
///   faces that do not hold it is injective, and no diagonal lies in a face;
/// - a loop of three: its triangle cuts off a corner of the cube, and everything else lies beyond its plane;
/// - the rest (a few per cent of the cells): all triangulations without diagonals in faces are tried by area, with an exact test.
///
/// Where none passes, a loop is joined to a point inside the cell: the projection from there onto the boundary is injective. An annulus
/// without ambiguous face joins two loops of three and needs no points of its own; the others get the six points of the waist (their
/// loops have edges to which no corner of the other loop can be joined outside the faces). Of 2.5 million random cells none was left
/// without a triangulation.
/// \throws std::logic_error if there is such a cell after all.
/// \param points  on the twelve edges of the cube, strictly between the ends; entries without crossing are not used.
/// \param tunnel  from `find_tunnel`, its waist in the coordinates of `points`.
/// \param patch   receives the result; its memory is used again.
void triangulate_cell(const std::array<Vec3, cube::kEdges>& points, const CellLoops& loops, const std::optional<Tunnel>& tunnel,
                      CellPatch& patch);

}  // namespace smopt
