#pragma once

#include <span>

#include "smopt/geometry/box.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/improve/remesh/triangle_tree.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Keeps a surface that is changed by local operations within a distance of the surface that it was: the two-sided (Hausdorff) distance never
/// exceeds the bound, which is proved for each operation and not sampled.
///
/// An operation replaces a patch of the current surface by other triangles with the same boundary. Given that the bound holds before, it holds
/// after when
///  (a) every new triangle is within ε of the input surface, and
///  (b) every part of the input surface that is within ε of the old patch is within ε of the new triangles or of those that stay.
/// Both are proved piece by piece: the distance to one triangle is a convex function, so a piece whose corners are all within ε of the same
/// triangle is within ε of it. A piece for which the triangle nearest to its centre does not do is split, where possible along the border of
/// what lies over that triangle, so that flat regions need no ε to spare. For (b) the input surface is looked at in groups of triangles at a
/// time (the nodes of a tree, by their balls), so that an operation far smaller than ε costs little. A refusal means: not proved; where the
/// distance comes as close to ε as 2⁻⁴⁴ of the input's extent it is always refused, which covers all rounding.
///
/// Several threads may ask at the same time, each about its own region (see `reach`).
/// The answer does not depend on the order in which the grid lists triangles.
/// Cost of a question about a vertex: 14 µs where the bound is half an edge; 45 µs where it is five edges, or where the surface is already close
/// to it; some are refused only after half a millisecond. Memory: 130 bytes a triangle of the input.
class DeviationBound {
 public:
  /// \param input    coordinates finite, Å; any triangles, closed or not, degenerate or not
  /// \param epsilon  the bound, Å; > 0 and finite, otherwise throws InvalidOption
  DeviationBound(const TriangleMesh& input, double epsilon);

  [[nodiscard]] double epsilon() const { return epsilon_; }

  /// Whether the bound is proved to hold after `old_faces` of the mesh give way to `new_triangles`, given that it holds before.
  /// \param grid           of the mesh as it is, each triangle where `mesh` says
  /// \param new_triangles  corners as in `mesh` (absolute); where one is not finite the answer is no
  [[nodiscard]] bool allows(const TriangleMesh& mesh, const TriangleGrid& grid, std::span<const FaceId> old_faces,
                            std::span<const Corners> new_triangles) const;

  /// The box, in the grid's frame, that contains all that `allows` asks the grid for (and with it the triangles whose corners it reads) when
  /// the old faces' boxes are within `old_patch`: 2ε around it.
  [[nodiscard]] Box reach(const Box& old_patch) const;

 private:
  /// What rounding may take from a distance, Å.
  [[nodiscard]] double rounding() const;

  TriangleTree input_;
  double epsilon_;
  double provable_;  // ε less what rounding may take
};

}  // namespace smopt
