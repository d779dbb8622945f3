#pragma once

#include <cstdint>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::bench {

/// Plain Laplacian smoothing without any test: the work that guarded smoothing is measured against.
///
/// Every vertex moves to the mean of its neighbours' positions of the round before (Jacobi), one thread, double precision, neighbours in
/// compressed rows with 32-bit indices, vertices in the order of the mesh. The rows are built by the constructor, which is not measured.
class FloorLaplacian {
 public:
  /// How the neighbours of a vertex are summed; the results differ by rounding at most.
  enum class Loop {
    branchless,      ///< the fastest that was found: a fixed number of additions, those past the row's end of a point at the origin
    straightforward  ///< as one writes it: a loop over the row. The end of a row is hard to predict, which takes about half of its time
  };

  /// \pre mesh is a closed, oriented manifold.
  explicit FloorLaplacian(const TriangleMesh& mesh);

  /// Starts anew from the mesh's positions, of which there must be as many as before.
  void reset(const TriangleMesh& mesh);
  /// Cost: 4 to 10 ns a vertex and round.
  void run(int rounds, Loop loop);

  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }  ///< and one more, the origin

 private:
  void sweep_branchless();
  void sweep_straightforward();

  std::vector<std::uint32_t> offsets_;  // vertex_count + 1
  std::vector<VertexId> neighbours_;    // one row a vertex; kSlots more at the end, so that a row can be read past its end
  std::vector<double> reciprocals_;     // 1/valence by valence
  std::vector<Vec3> points_, next_;     // vertex_count + 1: the last is the origin
};

}  // namespace smopt::bench
