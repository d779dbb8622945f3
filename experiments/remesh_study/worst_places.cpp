#include "experiments/remesh_study/worst_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "metrics/intersections.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

double angle_deg(const Vec3& at, const Vec3& to, const Vec3& other) {
  const Vec3 u = to - at, v = other - at;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

std::array<double, 3> angles_of(const TriangleMesh& mesh, FaceId f) {
  const auto& [a, b, c] = mesh.triangles[f];
  const Vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
  return {angle_deg(p, q, r), angle_deg(q, r, p), angle_deg(r, p, q)};
}

WorstPlace place_of(const TriangleMesh& mesh, FaceId f, double value) {
  const auto& [a, b, c] = mesh.triangles[f];
  return {f, (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3, value};
}

void find_angles(const TriangleMesh& mesh, WorstPlaces& places) {
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    const auto angles = angles_of(mesh, f);
    const auto [least, most] = std::ranges::minmax(angles);
    if (!std::isfinite(least) || !std::isfinite(most)) continue;
    if (!places.smallest_angle || least < places.smallest_angle->value) places.smallest_angle = place_of(mesh, f, least);
    if (!places.largest_angle || most > places.largest_angle->value) places.largest_angle = place_of(mesh, f, most);
  }
}

Json json_of(const std::optional<WorstPlace>& place) {
  if (!place) return nullptr;
  return {{"triangle", place->triangle}, {"point", {place->point.x(), place->point.y(), place->point.z()}}, {"value", place->value}};
}

}  // namespace

WorstPlaces find_worst_places(const TriangleMesh& mesh) {
  WorstPlaces places;
  find_angles(mesh, places);
  const metrics::Intersections found = metrics::find_intersections(mesh, {.list_limit = 1});
  if (!found.pairs.empty()) places.intersection = place_of(mesh, found.pairs.front().first, static_cast<double>(found.count.value_or(0)));
  return places;
}

Json to_json(const WorstPlaces& places) {
  return {{"smallest_angle", json_of(places.smallest_angle)},
          {"largest_angle", json_of(places.largest_angle)},
          {"intersection", json_of(places.intersection)}};
}

}  // namespace smopt::experiments
