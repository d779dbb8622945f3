#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

struct Sphere {
  Vec3 centre;        ///< Å
  double radius = 0;  ///< Å
};

/// An intersecting pair of triangles, and how a figure shows it.
struct PairView {
  std::pair<FaceId, FaceId> pair;
  std::array<Vec3, 2> crossing;  ///< the ends of the segment in which the two triangles meet, Å
  Vec3 towards;                  ///< unit vector from the pair to the viewer
  Sphere piece;                  ///< what is shown of the mesh, around the middle of the crossing
};

/// The pair that a figure shows, and the direction from which it shows it.
///
/// Of all pairs and `kDirections` directions it takes those for which the smallest of three lengths is largest, all as they show in parallel
/// projection: that of the crossing, and the square roots of the areas of the two triangles. Each triangle in front, of the pair or of the
/// piece around it, lets half through. So both triangles and their crossing are large and in view. Of equals, that which comes first is taken.
/// \param pairs  of `mesh`, as find_intersections lists them.
/// \return nothing where no pair shows: all of them touch in a point or lie in one plane.
/// Cost: a look at all triangles, and at the piece from all directions, for each pair that may be better than the best before it.
std::optional<PairView> find_pair_view(const TriangleMesh& mesh, std::span<const std::pair<FaceId, FaceId>> pairs);

/// Directions that are tried, spread evenly over the sphere: neighbours are some ten degrees apart.
inline constexpr int kDirections = 400;

/// The triangles that have a corner in the sphere.
std::vector<FaceId> faces_in(const TriangleMesh& mesh, const Sphere& sphere);

/// The ends of the segment in which two triangles cross, in floating point; nothing where they meet in a point, in a plane, or not at all.
std::optional<std::array<Vec3, 2>> crossing_of(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace smopt::experiments
