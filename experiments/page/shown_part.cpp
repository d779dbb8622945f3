#include "experiments/page/shown_part.h"

#include <algorithm>

#include "smopt/mesh/compact.h"

namespace smopt::experiments {
namespace {

Vec3 centroid(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
}

bool is_drawable(const TriangleMesh& mesh, const Triangle& t, const Vec3& centre) {
  return std::ranges::all_of(t, [&](VertexId v) { return (mesh.points[v] - centre).norm() <= kFarthestDrawn; });  // false for NaN
}

}  // namespace

Ball ball_around(const TriangleMesh& mesh, const Vec3& centre, std::size_t triangles) {
  if (mesh.triangle_count() <= triangles) return {centre, Ball{}.radius};
  std::vector<double> distances;
  distances.reserve(mesh.triangle_count());
  for (const Triangle& t : mesh.triangles) {
    if (is_drawable(mesh, t, centre)) distances.push_back((centroid(mesh, t) - centre).norm());
  }
  if (distances.size() <= triangles || triangles == 0) return {centre, Ball{}.radius};
  const auto last = distances.begin() + static_cast<std::ptrdiff_t>(triangles - 1);
  std::nth_element(distances.begin(), last, distances.end());
  return {centre, *last};
}

ShownPart shown_part(const TriangleMesh& mesh, const Ball& ball) {
  ShownPart part;
  for (FaceId face = 0; face < mesh.triangle_count(); ++face) {
    const Triangle& t = mesh.triangles[face];
    if (!is_drawable(mesh, t, ball.centre)) {
      ++part.undrawable;
    } else if ((centroid(mesh, t) - ball.centre).norm() <= ball.radius) {
      part.mesh.triangles.push_back(t);
      part.faces.push_back(face);
    }
  }
  part.mesh.points = mesh.points;
  remove_isolated_vertices(part.mesh);
  return part;
}

}  // namespace smopt::experiments
