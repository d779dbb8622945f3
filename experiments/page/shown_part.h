#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// A place on a surface and how far around it is looked. Ångström.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = std::numeric_limits<double>::infinity();  ///< infinite: all is shown

  [[nodiscard]] bool is_whole() const { return radius == std::numeric_limits<double>::infinity(); }
};

/// The smallest ball around `centre` that holds the centroids of `triangles` triangles of the mesh; infinite where it has no more than that
/// many. Cost: O(n).
Ball ball_around(const TriangleMesh& mesh, const Vec3& centre, std::size_t triangles);

/// The triangles of a mesh that are drawn.
struct ShownPart {
  TriangleMesh mesh;           ///< with the vertices they use, in the order of the whole mesh
  std::vector<FaceId> faces;   ///< which triangle of the whole mesh each of them is, ascending
  std::size_t undrawable = 0;  ///< triangles with a corner that is not finite or beyond `kFarthestDrawn`, which are left out
};

/// How far from the ball's centre a corner may be, Å. An unstable method throws vertices to 1e30 and farther; the card's single precision has
/// steps of 0.06 Å here.
inline constexpr double kFarthestDrawn = 1e6;

/// The drawable triangles whose centroid lies in the ball. Cost: O(n).
ShownPart shown_part(const TriangleMesh& mesh, const Ball& ball);

}  // namespace smopt::experiments
