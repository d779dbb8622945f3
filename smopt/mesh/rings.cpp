#include "smopt/mesh/rings.h"

#include <algorithm>

namespace smopt {
namespace {

/// A triangle of a star: it leads from one ring vertex to the next.
struct Spoke {
  VertexId from, to;
  FaceId face;
};

std::vector<Spoke>& spokes_of(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star) {
  thread_local std::vector<Spoke> spokes;
  spokes.clear();
  for (const FaceId f : star) {
    const Triangle& t = mesh.triangles[f];
    const int corner = corner_of(t, v);
    spokes.push_back({t[corner < 2 ? corner + 1 : 0], t[corner > 0 ? corner - 1 : 2], f});
  }
  return spokes;
}

/// Up to this many triangles a star is searched from end to end for the next one; larger stars are sorted first.
constexpr std::size_t kLinearSearch = 32;

/// Brings the spokes into the order of the ring, each beginning where the one before ends; false where they form no single cycle, or where
/// two begin at the same vertex. Cost: O(d log d).
bool sort_large_into_cycle(std::vector<Spoke>& spokes) {
  std::vector<Spoke> sorted = spokes;
  const auto is_before = [](const Spoke& a, const Spoke& b) { return a.from < b.from; };
  std::sort(sorted.begin(), sorted.end(), is_before);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].from == sorted[i - 1].from) return false;
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    const auto next = std::lower_bound(sorted.begin(), sorted.end(), Spoke{spokes[i - 1].to, 0, 0}, is_before);
    if (next == sorted.end() || next->from != spokes[i - 1].to || next->from == spokes.front().from) return false;
    spokes[i] = *next;
  }
  return spokes.back().to == spokes.front().from;
}

/// The same for stars of ordinary size, in place.
bool sort_into_cycle(std::vector<Spoke>& spokes) {
  if (spokes.size() > kLinearSearch) return sort_large_into_cycle(spokes);
  for (std::size_t i = 0; i + 1 < spokes.size(); ++i) {
    const auto rest = spokes.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto continues = [to = spokes[i].to](const Spoke& s) { return s.from == to; };
    const auto next = std::find_if(rest, spokes.end(), continues);
    if (next == spokes.end() || std::any_of(next + 1, spokes.end(), continues)) return false;
    std::iter_swap(rest, next);
  }
  return spokes.back().to == spokes.front().from;
}

}  // namespace

bool append_ring(const TriangleMesh& mesh, VertexId v, std::span<const FaceId> star, std::vector<VertexId>& vertices,
                 std::vector<FaceId>& faces) {
  if (star.size() < 3) return false;
  std::vector<Spoke>& spokes = spokes_of(mesh, v, star);
  if (!sort_into_cycle(spokes)) return false;
  for (const Spoke& spoke : spokes) {
    vertices.push_back(spoke.from);
    faces.push_back(spoke.face);
  }
  return true;
}

std::optional<VertexRings> build_rings(const TriangleMesh& mesh) {
  const VertexStars stars = build_stars(mesh);
  VertexRings rings;
  rings.ring_vertices.reserve(stars.faces.size());
  rings.ring_faces.reserve(stars.faces.size());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!stars[v].empty() && !append_ring(mesh, v, stars[v], rings.ring_vertices, rings.ring_faces)) return std::nullopt;
  rings.offsets = stars.offsets;
  return rings;
}

}  // namespace smopt
