#include "smopt/mesh/rings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <tuple>
#include <utility>

#include "smopt/geometry/lanes.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// No vertex: there are fewer.
constexpr VertexId kNoVertex = 0xFFFFFFFF;

/// The ring vertices that triangle t of the star of v leads from and to. A triangle in which v is repeated stands in the star once for each
/// time and gives the same each time, so that it is in no ring.
std::pair<VertexId, VertexId> spoke_of(const Triangle& t, VertexId v) {
  static constexpr std::array<unsigned char, 4> kNext = {1, 2, 0, 0}, kPrevious = {2, 0, 1, 0};
  const unsigned corner = (t[1] == v ? 1U : 0U) | (t[2] == v ? 2U : 0U);  // looked up, not branched on: there is no pattern to predict
  return {t[kNext[corner]], t[kPrevious[corner]]};
}

/// Puts the triangles of a star of at most `kCapacity` into the order of the ring, each beginning where the one before ends; false where
/// they form no single cycle, or where two begin at the same vertex. Where a triangle leads is compared with the beginnings of all others
/// at once, so that no branch depends on the order in which they come. `faces` may be the star itself.
template <std::size_t kCapacity>
bool order_small(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, VertexId* ring, FaceId* faces) {
  std::array<VertexId, kCapacity> from, to;
  std::array<FaceId, kCapacity> unordered;
  from.fill(kNoVertex);
  for (std::size_t i = 0; i < star.size(); ++i) {
    unordered[i] = star[i];
    std::tie(from[i], to[i]) = spoke_of(mesh.triangles[star[i]], v);
  }
  std::array<Masks, kCapacity / kLanes> beginnings;
  std::memcpy(beginnings.data(), from.data(), sizeof beginnings);
  const auto beginning_at = [&beginnings](VertexId w) {
    const auto wanted = static_cast<std::int32_t>(w);
    unsigned found = 0;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < beginnings.size(); ++j)
      found |= lanes_set(beginnings[j] == Masks{wanted, wanted, wanted, wanted}) << kLanes * j;
    return found;
  };
  std::size_t at = 0;
  for (std::size_t i = 0; i < star.size(); ++i) {
    ring[i] = from[at];
    faces[i] = unordered[at];
    const unsigned next = beginning_at(to[at]);
    const bool is_one = next != 0 && (next & (next - 1)) == 0, is_closed = next == 1, is_last = i + 1 == star.size();
    if (!is_one || is_closed != is_last) return false;
    at = static_cast<std::size_t>(std::countr_zero(next));
  }
  return true;
}

/// The same for a star of any size. Cost: O(d log d).
bool order_large(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, VertexId* ring, FaceId* faces) {
  struct Spoke {
    VertexId from, to;
    FaceId face;
  };
  std::vector<Spoke> spokes;
  spokes.reserve(star.size());
  for (const FaceId f : star) {
    const auto [from, to] = spoke_of(mesh.triangles[f], v);
    spokes.push_back({from, to, f});
  }
  const Spoke first = spokes.front();
  std::ranges::sort(spokes, {}, &Spoke::from);
  if (std::ranges::adjacent_find(spokes, {}, &Spoke::from) != spokes.end()) return false;
  Spoke spoke = first;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    ring[i] = spoke.from;
    faces[i] = spoke.face;
    const auto next = std::ranges::lower_bound(spokes, spoke.to, {}, &Spoke::from);
    const bool is_closed = spoke.to == first.from, is_last = i + 1 == spokes.size();
    if (next == spokes.end() || next->from != spoke.to || is_closed != is_last) return false;
    spoke = *next;
  }
  return true;
}

/// Orders the star of v into `ring` and `faces`, both of its size; what these hold is undefined where there is no ring.
bool order_star(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, VertexId* ring, FaceId* faces) {
  if (star.size() < 3) return false;
  if (star.size() <= 8) return order_small<8>(mesh, v, star, ring, faces);
  if (star.size() <= 16) return order_small<16>(mesh, v, star, ring, faces);
  return order_large(mesh, v, star, ring, faces);
}

/// Calls is_true(v) for all vertices, on all threads, until one is not; whether all are.
template <class Predicate>
bool is_true_for_all(std::size_t vertex_count, const Predicate& is_true) {
  std::atomic<bool> are_all = true;
  for_ranges_in_parallel(vertex_count, [&](std::size_t begin, std::size_t end) {
    if (!are_all.load(std::memory_order_relaxed)) return;
    for (std::size_t v = begin; v < end; ++v)
      if (!is_true(static_cast<VertexId>(v))) return are_all.store(false, std::memory_order_relaxed);
  });
  return are_all;
}

}  // namespace

bool append_ring(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, std::vector<VertexId>& vertices,
                 std::vector<FaceId>& faces) {
  const std::size_t vertices_before = vertices.size(), faces_before = faces.size();
  vertices.resize(vertices_before + star.size());
  faces.resize(faces_before + star.size());
  const bool is_ring = order_star(mesh, v, star, vertices.data() + vertices_before, faces.data() + faces_before);
  if (!is_ring) {
    vertices.resize(vertices_before);
    faces.resize(faces_before);
  }
  return is_ring;
}

bool has_all_rings(const TriangleMesh& mesh, const VertexStars& stars) {
  return is_true_for_all(mesh.vertex_count(), [&](VertexId v) {
    thread_local std::vector<std::uint32_t> ring, faces;
    ring.resize(std::max(ring.size(), stars[v].size()));
    faces.resize(ring.size());
    return stars[v].empty() || order_star(mesh, v, stars[v], ring.data(), faces.data());
  });
}

std::optional<VertexRings> build_rings(const TriangleMesh& mesh) {
  VertexStars stars = build_stars(mesh);
  VertexRings rings{std::vector<VertexRings::Row>(mesh.vertex_count()), std::vector<VertexId>(stars.faces.size()), std::move(stars.faces)};
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) rings.rows[v] = {stars.offsets[v], stars.offsets[v + 1] - stars.offsets[v]};
  const bool is_manifold = is_true_for_all(mesh.vertex_count(), [&](VertexId v) {
    const std::uint32_t row = rings.rows[v].begin;
    return rings.valence(v) == 0 || order_star(mesh, v, rings.faces(v), rings.ring_vertices.data() + row, rings.ring_faces.data() + row);
  });
  return is_manifold ? std::optional(std::move(rings)) : std::nullopt;
}

}  // namespace smopt
