#pragma once

#include <string>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// Which edge is collapsed next, and where its vertex goes.
enum class CollapsePlacement {
  midpoint,       ///< the shortest edge, to its midpoint: what ISO2mesh does for a positive ratio
  lindstrom_turk  ///< CGAL's default, Lindstrom & Turk 1998 and 1999: what it does for a negative one, and its manual names
};

struct ResampleOptions {
  std::size_t vertices = 0;  ///< to end with, isolated ones included
  CollapsePlacement placement = CollapsePlacement::midpoint;
  /// Significant digits that positions are rounded to, 1..17: the text file by which ISO2mesh gets the mesh back has 6. 0: not rounded, and
  /// nothing is merged.
  int digits = 6;
};

struct ResampleReport {
  std::size_t vertices_before = 0;
  std::size_t vertices_after = 0;
  std::size_t merged_vertices = 0;  ///< equal after rounding, and made one
  /// Whether vertices_after is within kResampleTolerance of what was asked for. It is not where no edge may be collapsed any more (a
  /// tetrahedron stays), where edges without length, which all go, or merged vertices are many, or where there were too few vertices.
  bool is_target_met = false;
};

/// Part of the wanted number of vertices by which the result may be off.
inline constexpr double kResampleTolerance = 1e-3;

/// ISO2mesh's `meshresample` with its program `cgalsimp2`: CGAL's edge collapse over doubles until the ratio of edges left (keepratio) is
/// that of the wanted number of vertices. Edges at a border are not collapsed; the link condition keeps the topology; nothing keeps the
/// surface from intersecting itself. Then what its text file does: positions are rounded, and vertices that have become equal are merged
/// into the first of them. Triangles are left as they are, even where merging makes two the same or gives one the same corner twice.
///
/// Other than there: the mesh is CGAL's Surface_mesh, not its Polyhedron_3 (another order among edges of the same cost); the ratio is a
/// double that stands for a whole number of vertices (there a float of the user's choice); vertices keep CGAL's order and are not sorted by
/// position.
/// Nothing is done when the mesh has no more vertices than wanted. The same mesh gives the same bytes.
/// \throws InvalidMesh unless the mesh is an oriented manifold (it may be open); InvalidOption; Cancelled. Cost: O(n log n); from 65 000
/// vertices to 60 000 takes 0.15 s, to 5000 a second.
ResampleReport resample(TriangleMesh& mesh, const ResampleOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt::baselines
