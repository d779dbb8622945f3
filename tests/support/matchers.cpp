#include "tests/support/matchers.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace smopt::testing {
namespace {

using Edge = std::pair<VertexId, VertexId>;

std::string why_edges_not_closed(const TriangleMesh& mesh) {
  std::map<Edge, int> directed;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++directed[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : directed) {
    if (edge.first == edge.second) return fmt::format("edge {}-{} is a loop", edge.first, edge.second);
    if (count != 1) return fmt::format("edge {}-{} is used {} times in one direction", edge.first, edge.second, count);
    if (!directed.contains({edge.second, edge.first})) return fmt::format("edge {}-{} has one triangle only", edge.first, edge.second);
  }
  return {};
}

std::string why_stars_not_fans(const TriangleMesh& mesh) {
  std::map<VertexId, std::map<VertexId, VertexId>> next_on_ring;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) next_on_ring[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
  for (const auto& [v, next] : next_on_ring) {
    std::size_t steps = 0;
    VertexId at = next.begin()->first;
    do {
      const auto it = next.find(at);
      if (it == next.end()) return fmt::format("the ring of vertex {} is open", v);
      at = it->second;
    } while (++steps <= next.size() && at != next.begin()->first);
    if (steps != next.size()) return fmt::format("vertex {} has more than one fan", v);
  }
  return {};
}

}  // namespace

std::string why_not_closed_manifold(const TriangleMesh& mesh) {
  const std::string edges = why_edges_not_closed(mesh);
  return edges.empty() ? why_stars_not_fans(mesh) : edges;
}

int euler_characteristic(const TriangleMesh& mesh) {
  std::set<VertexId> vertices;
  std::set<Edge> edges;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      vertices.insert(t[i]);
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(mesh.triangles.size());
}

double enclosed_volume(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0;
  const Vec3 origin = mesh.points.front();
  double six_volumes = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes += (mesh.points[a] - origin).dot((mesh.points[b] - origin).cross(mesh.points[c] - origin));
  return six_volumes / 6;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  return area;
}

}  // namespace smopt::testing
