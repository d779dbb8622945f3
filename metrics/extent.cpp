#include "metrics/extent.h"

#include <Eigen/Geometry>

#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

double volume_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) box.extend(mesh.points[v]);
  const Vec3 o = box.center();
  double sixfold = 0;
  for (const auto& [a, b, c] : mesh.triangles) sixfold += (mesh.points[a] - o).dot((mesh.points[b] - o).cross(mesh.points[c] - o));
  return sixfold / 6;
}

/// Empty when the volume exists.
std::string why_no_volume(const Topology& topology) {
  if (topology.triangles == 0) return "the mesh has no triangles";
  if (!topology.closed) return "the surface is not closed";
  if (!topology.oriented) return "the surface is not consistently oriented";
  return {};
}

}  // namespace

double surface_area(const TriangleMesh& mesh) {
  double doubled = 0;
  for (const auto& [a, b, c] : mesh.triangles) doubled += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  return doubled / 2;
}

Extent measure_extent(const TriangleMesh& mesh, const Topology& topology, std::vector<std::string>& notes) {
  Extent extent;
  if (!has_finite_triangles(mesh)) {
    notes.push_back("area, volume: a triangle has a corner that is not finite");
    return extent;
  }
  extent.area = surface_area(mesh);
  if (const std::string why = why_no_volume(topology); why.empty())
    extent.volume = volume_of(mesh);
  else
    notes.push_back("volume: " + why);
  return extent;
}

}  // namespace smopt::metrics
