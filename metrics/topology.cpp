#include "metrics/topology.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "metrics/degenerate.h"
#include "metrics/edges.h"
#include "metrics/union_find.h"

namespace smopt::metrics {
namespace {

struct VertexUse {
  std::vector<bool> used;
  std::size_t count = 0;
};

VertexUse used_vertices(const TriangleMesh& mesh) {
  VertexUse use{std::vector<bool>(mesh.vertex_count(), false), 0};
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) use.used[v] = true;
  use.count = static_cast<std::size_t>(std::count(use.used.begin(), use.used.end(), true));
  return use;
}

std::size_t count_components(const TriangleMesh& mesh, const VertexUse& use) {
  UnionFind sets(mesh.vertex_count());
  for (const Triangle& t : mesh.triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  std::size_t components = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (use.used[v] && sets.root(v) == v) ++components;
  return components;
}

std::size_t count_duplicates(const std::vector<Vec3>& points) {
  std::vector<VertexId> order;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (points[v].allFinite()) order.push_back(static_cast<VertexId>(v));
  const auto less = [&](VertexId a, VertexId b) {
    const Vec3& p = points[a];
    const Vec3& q = points[b];
    return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
  };
  std::sort(order.begin(), order.end(), less);
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    if (points[order[i]] == points[order[i - 1]]) ++duplicates;
  return duplicates;
}

struct EdgeFacts {
  std::size_t count = 0;
  bool has_boundary = false;
  bool manifold = true;
  bool oriented = true;
};

EdgeFacts edge_facts(std::span<const EdgeUse> uses) {
  EdgeFacts facts;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    ++facts.count;
    const auto forward = static_cast<std::size_t>(std::count_if(edge.begin(), edge.end(), [](const EdgeUse& u) { return u.forward; }));
    if (edge.size() == 1) facts.has_boundary = true;
    if (edge.size() > 2) facts.manifold = false;
    if (edge.size() > 1 && 2 * forward != edge.size()) facts.oriented = false;
  });
  return facts;
}

/// The number of fans at each vertex: sets of its triangles that are connected through edges at the vertex.
std::vector<std::uint32_t> count_fans(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  UnionFind corners(3 * mesh.triangle_count());
  const auto corner_at = [](const EdgeUse& u, bool low) {
    return std::size_t{3} * u.face + (low == u.forward ? u.side : (u.side + 1U) % 3U);
  };
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (std::size_t i = 1; i < edge.size(); ++i)
      for (const bool low : {true, false}) corners.unite(corner_at(edge[i - 1], low), corner_at(edge[i], low));
  });
  std::vector<std::uint32_t> fans(mesh.vertex_count(), 0);
  for (std::size_t c = 0; c < 3 * mesh.triangle_count(); ++c)
    if (corners.root(c) == c) ++fans[mesh.triangles[c / 3][c % 3]];
  return fans;
}

std::optional<std::int64_t> genus_of(const Topology& t, std::vector<std::string>& notes) {
  if (t.triangles == 0) {
    notes.push_back("genus: the mesh has no triangles");
  } else if (!t.closed || !t.edge_manifold || !t.vertex_manifold) {
    notes.push_back("genus: the surface is not a closed manifold");
  } else if (t.euler_characteristic % 2 != 0) {
    notes.push_back("genus: the surface is not orientable");
  } else {
    return static_cast<std::int64_t>(t.components) - t.euler_characteristic / 2;
  }
  return std::nullopt;
}

std::size_t count_true(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

}  // namespace

Topology measure_topology(const TriangleMesh& mesh, std::vector<std::string>& notes) {
  const VertexUse use = used_vertices(mesh);
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  const EdgeFacts edges = edge_facts(uses);
  const std::vector<std::uint32_t> fans = count_fans(mesh, uses);
  const bool three_sides = std::none_of(mesh.triangles.begin(), mesh.triangles.end(), names_a_vertex_twice);

  Topology t;
  t.vertices = mesh.vertex_count();
  t.triangles = mesh.triangle_count();
  t.edges = edges.count;
  t.components = count_components(mesh, use);
  t.euler_characteristic =
      static_cast<std::int64_t>(use.count) - static_cast<std::int64_t>(edges.count) + static_cast<std::int64_t>(mesh.triangle_count());
  t.closed = !mesh.triangles.empty() && three_sides && !edges.has_boundary;
  t.edge_manifold = edges.manifold && three_sides;
  t.vertex_manifold = t.edge_manifold && std::all_of(fans.begin(), fans.end(), [](std::uint32_t n) { return n <= 1; });
  t.oriented = edges.oriented;
  t.genus = genus_of(t, notes);
  t.isolated_vertices = mesh.vertex_count() - use.count;
  t.duplicate_vertices = count_duplicates(mesh.points);
  t.degenerate_triangles = count_true(degenerate_triangles(mesh));
  t.nonfinite_vertices =
      static_cast<std::size_t>(std::count_if(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return !p.allFinite(); }));
  return t;
}

}  // namespace smopt::metrics
