#include "experiments/page/mesh_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "experiments/page/packed_words.h"
#include "experiments/page/worst_triangles.h"
#include "metrics/intersections.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::string packed_positions(const TriangleMesh& mesh, const Vec3& centre) {
  std::vector<std::uint32_t> words;
  words.reserve(3 * mesh.vertex_count());
  for (const Vec3& point : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(point[axis] - centre[axis])));
  }
  return pack_words(words, 3);
}

std::string packed_indices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> words;
  words.reserve(3 * mesh.triangle_count());
  for (const Triangle& t : mesh.triangles) words.insert(words.end(), t.begin(), t.end());
  return pack_words(words, 1);
}

/// Where a triangle of the whole mesh stands among the shown. \pre it is shown
std::size_t shown_index(const ShownPart& part, FaceId face) {
  return static_cast<std::size_t>(std::ranges::lower_bound(part.faces, face) - part.faces.begin());
}

Json worst_json(const TriangleMesh& mesh, const ShownPart& part) {
  Json result;
  for (const TriangleMeasure measure : kTriangleMeasures) {
    Json& list = result[std::string(to_string(measure))] = Json::array();
    for (const RankedTriangle& triangle : worst_triangles(mesh, measure, part.faces, kListedTriangles))
      list.push_back({shown_index(part, triangle.face), triangle.face, triangle.value, triangle.rank});
  }
  return result;
}

Json pairs_json(const ShownPart& part, bool has_pairs) {
  metrics::Intersections found;
  found.count = 0;
  if (has_pairs) found = metrics::find_intersections(part.mesh, {kListedPairs, kSearchedPairs});
  Json listed = Json::array();
  for (const auto& [f, g] : found.pairs) listed.push_back({f, g, part.faces[f], part.faces[g]});
  return {{"count", found.count ? Json(*found.count) : Json()}, {"listed", std::move(listed)}, {"why_not_counted", found.why_not_counted}};
}

Vec3 middle_of(const TriangleMesh& mesh, FaceId face) {
  const Triangle& t = mesh.triangles[face];
  return (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
}

Vec3 middle_of_box(const TriangleMesh& mesh) {
  Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
  for (const Vec3& point : mesh.points) {
    if (!point.allFinite()) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return low.allFinite() ? Vec3((low + high) / 2) : Vec3::Zero();
}

Vec3 worst_place(const TriangleMesh& mesh, bool has_pairs) {
  if (has_pairs) {
    const metrics::Intersections found = metrics::find_intersections(mesh, {1, kSearchedPairs});
    if (!found.pairs.empty()) return (middle_of(mesh, found.pairs[0].first) + middle_of(mesh, found.pairs[0].second)) / 2;
  }
  std::vector<FaceId> faces(mesh.triangle_count());
  std::iota(faces.begin(), faces.end(), FaceId{0});
  const std::vector<RankedTriangle> worst = worst_triangles(mesh, TriangleMeasure::smallest_angle, faces, 1);
  return worst.empty() ? middle_of_box(mesh) : middle_of(mesh, worst[0].face);
}

}  // namespace

MeshView mesh_view(const TriangleMesh& mesh, const Ball& ball, bool has_pairs) {
  const ShownPart part = shown_part(mesh, ball);
  MeshView view;
  view.positions = packed_positions(part.mesh, ball.centre);
  view.indices = packed_indices(part.mesh);
  view.facts = {{"vertices", mesh.vertex_count()},
                {"triangles", mesh.triangle_count()},
                {"shown_vertices", part.mesh.vertex_count()},
                {"shown_triangles", part.mesh.triangle_count()},
                {"undrawable_triangles", part.undrawable},
                {"worst", worst_json(mesh, part)},
                {"pairs", pairs_json(part, has_pairs)}};
  return view;
}

Ball ball_to_show(const TriangleMesh& initial, std::size_t shown, bool has_pairs) {
  if (initial.triangle_count() <= shown) return {middle_of_box(initial), Ball{}.radius};
  return ball_around(initial, worst_place(initial, has_pairs), shown);
}

}  // namespace smopt::experiments
