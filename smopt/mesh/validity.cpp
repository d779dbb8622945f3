#include "smopt/mesh/validity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "smopt/error.h"
#include "smopt/mesh/disjoint_sets.h"
#include "smopt/mesh/edge_sides.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/stars.h"

namespace smopt {
namespace {

template <class... Args>
void note(Fault& fault, fmt::format_string<Args...> format, Args&&... args) {
  if (fault.count++ < kMaxFaultExamples) fault.examples.push_back(fmt::format(format, std::forward<Args>(args)...));
}

void find_nonfinite_vertices(const TriangleMesh& mesh, ValidityReport& report) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = mesh.points[v];
    if (!p.allFinite()) note(report.nonfinite_vertices, "vertex {} at ({}, {}, {})", v, p[0], p[1], p[2]);
  }
}

void find_repeated_corners(const TriangleMesh& mesh, ValidityReport& report) {
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    const Triangle& t = mesh.triangles[f];
    if (has_repeated_corner(t)) note(report.repeated_corners, "face {} ({} {} {})", f, t[0], t[1], t[2]);
  }
}

void find_bad_edges(const TriangleMesh& mesh, ValidityReport& report) {
  const std::vector<EdgeSide> edges = sorted_edge_sides(mesh);
  for (auto it = edges.begin(); it != edges.end();) {
    const auto end = std::find_if(it, edges.end(), [&](const EdgeSide& e) { return e.low != it->low || e.high != it->high; });
    const auto uses = end - it;
    if (uses == 1) note(report.boundary_edges, "edge {}-{} (face {})", it->low, it->high, it->face);
    if (uses > 2) note(report.nonmanifold_edges, "edge {}-{} with {} faces (face {} first)", it->low, it->high, uses, it->face);
    if (uses == 2 && it->is_ascending == (it + 1)->is_ascending)
      note(report.inconsistent_edges, "edge {}-{} (faces {} and {})", it->low, it->high, it->face, (it + 1)->face);
    it = end;
  }
}

void find_duplicate_faces(const TriangleMesh& mesh, ValidityReport& report) {
  std::vector<std::pair<Triangle, FaceId>> faces;
  faces.reserve(mesh.triangle_count());
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    Triangle t = mesh.triangles[f];
    std::sort(t.begin(), t.end());
    faces.emplace_back(t, f);
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].first == faces[i - 1].first) note(report.duplicate_faces, "faces {} and {}", faces[i - 1].second, faces[i].second);
}

/// How many fans (groups connected by edges) the triangles around v form. Cost: O(d log d).
std::size_t count_fans(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star) {
  std::vector<std::pair<VertexId, std::uint32_t>> edges;  // the edge's other end, and which triangle of the star has it
  for (std::uint32_t i = 0; i < star.size(); ++i)
    for (const VertexId w : mesh.triangles[star[i]])
      if (w != v) edges.emplace_back(w, i);
  std::sort(edges.begin(), edges.end());
  DisjointSets sets(star.size());
  std::size_t fans = star.size();
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].first == edges[i - 1].first && sets.unite(edges[i].second, edges[i - 1].second)) --fans;
  return fans;
}

void find_nonmanifold_vertices(const TriangleMesh& mesh, const VertexStars& stars, ValidityReport& report) {
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t fans = stars[v].empty() ? 1 : count_fans(mesh, v, stars[v]);
    if (fans > 1) note(report.nonmanifold_vertices, "vertex {} with {} fans", v, fans);
  }
}

/// The slow search, once something is known to be wrong.
void find_faults(const TriangleMesh& mesh, const VertexStars& stars, ValidityReport& report) {
  find_repeated_corners(mesh, report);
  find_bad_edges(mesh, report);
  find_duplicate_faces(mesh, report);
  find_nonmanifold_vertices(mesh, stars, report);
}

}  // namespace

bool ValidityReport::is_closed_manifold() const {
  return !is_empty && !nonfinite_vertices.any() && !repeated_corners.any() && !boundary_edges.any() && !nonmanifold_edges.any() &&
         !nonmanifold_vertices.any() && !duplicate_faces.any();
}

std::string ValidityReport::describe() const {
  const std::array<std::pair<const Fault*, const char*>, 7> kinds = {{
      {&nonfinite_vertices, "vertices with a coordinate that is not finite"},
      {&repeated_corners, "triangles with a repeated corner"},
      {&boundary_edges, "boundary edges (the surface is open)"},
      {&nonmanifold_edges, "non-manifold edges"},
      {&inconsistent_edges, "edges with inconsistent orientation"},
      {&nonmanifold_vertices, "non-manifold vertices"},
      {&duplicate_faces, "duplicate faces"},
  }};
  std::vector<std::string> parts;
  if (is_empty) parts.emplace_back("the mesh has no triangles");
  for (const auto& [fault, name] : kinds) {
    if (!fault->any()) continue;
    const bool has_more = fault->count > fault->examples.size();
    parts.push_back(fmt::format("{} {}: {}{}", fault->count, name, fmt::join(fault->examples, ", "), has_more ? ", …" : ""));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

ValidityReport check_validity(const TriangleMesh& mesh) {
  ValidityReport report;
  report.is_empty = mesh.triangles.empty();
  find_nonfinite_vertices(mesh, report);
  const VertexStars stars = build_stars(mesh);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) report.isolated_vertices += stars[v].empty() ? 1 : 0;
  if (!has_all_rings(mesh, stars)) find_faults(mesh, stars, report);
  return report;
}

void require_closed_manifold(const ValidityReport& report) {
  if (!report.is_closed_manifold()) throw InvalidMesh("not a closed manifold: " + report.describe());
}

}  // namespace smopt
