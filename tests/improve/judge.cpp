#include "tests/improve/judge.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>

#include "metrics/intersections.h"

namespace smopt::testing {

std::vector<FacePair> intersecting_pairs(const TriangleMesh& mesh) {
  return metrics::find_intersections(mesh).pairs;
}

std::vector<FacePair> new_pairs(const std::vector<FacePair>& before, const TriangleMesh& after) {
  const std::vector<FacePair> all = intersecting_pairs(after);
  std::vector<FacePair> result;
  std::set_difference(all.begin(), all.end(), before.begin(), before.end(), std::back_inserter(result));
  return result;
}

std::vector<FacePair> new_pairs(const TriangleMesh& before, const TriangleMesh& after) {
  return new_pairs(intersecting_pairs(before), after);
}

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double solid_angle = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.points[i] - point, b = mesh.points[j] - point, c = mesh.points[k] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle / (4 * std::numbers::pi);
}

double smallest_angle_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto angle = [](const Vec3& at, const Vec3& p, const Vec3& q) {
    return std::atan2((p - at).cross(q - at).norm(), (p - at).dot(q - at)) * 180 / std::numbers::pi;
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

double smallest_angle_deg(const TriangleMesh& mesh) {
  double smallest = 60;
  for (const auto& [a, b, c] : mesh.triangles)
    smallest = std::min(smallest, smallest_angle_deg(mesh.points[a], mesh.points[b], mesh.points[c]));
  return smallest;
}

double edge_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  return std::min({ab, bc, ca}) / std::max({ab, bc, ca});
}

std::vector<std::size_t> valences(const TriangleMesh& mesh) {
  std::vector<std::size_t> valence(mesh.vertex_count(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) ++valence[v];
  return valence;
}

TriangleMesh part_of(const TriangleMesh& mesh, std::size_t first, std::size_t count) {
  const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
  return {mesh.points, {begin, begin + static_cast<std::ptrdiff_t>(count)}};
}

bool is_same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vec3)) == 0;
}

}  // namespace smopt::testing
