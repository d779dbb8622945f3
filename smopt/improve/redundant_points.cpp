#include "smopt/improve/redundant_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/geometry/triangle_intersection.h"
#include "smopt/geometry/triangle_shape.h"
#include "smopt/mesh/compact.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/stars.h"

namespace smopt {
namespace {

/// Vertices between two progress reports.
constexpr std::size_t kProgressStride = 65536;

/// The stars of a mesh that only loses vertices of valence 3 and 4: no star ever grows, so rows are edited in place.
class ShrinkingStars {
 public:
  explicit ShrinkingStars(const TriangleMesh& mesh) : stars_(build_stars(mesh)), valence_(mesh.vertex_count()) {
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) valence_[v] = static_cast<std::uint32_t>(stars_[v].size());
  }

  [[nodiscard]] std::span<const FaceId> operator[](VertexId v) const { return stars_[v].first(valence_[v]); }
  [[nodiscard]] std::uint32_t valence(VertexId v) const { return valence_[v]; }

  void remove(VertexId v, FaceId f) {
    FaceId* row = stars_.faces.data() + stars_.offsets[v];
    std::swap(*std::find(row, row + valence_[v], f), row[valence_[v] - 1]);
    --valence_[v];
  }
  /// \pre a triangle of v was removed before.
  void add(VertexId v, FaceId f) { stars_.faces[stars_.offsets[v] + valence_[v]++] = f; }

 private:
  VertexStars stars_;
  std::vector<std::uint32_t> valence_;
};

/// The triangles that would take a vertex's place: the ring's triangle, or the two along a diagonal.
struct Replacement {
  std::array<Triangle, 2> triangles{};
  std::size_t count = 0;
};

enum class Verdict { not_redundant, link_refused, meeting_refused, removed };

class RedundantPointRemover {
 public:
  RedundantPointRemover(TriangleMesh& mesh, const RedundantPointOptions& options)
      : mesh_(mesh), options_(options), stars_(mesh), grid_(mesh.points, mesh.triangles), is_removed_(mesh.triangle_count(), 0) {}

  RedundantPointReport run(const ProgressCallback& progress) {
    RedundantPointReport report;
    std::vector<VertexId> to_visit;
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
      if (is_small_valence(v)) to_visit.push_back(v);
    while (!to_visit.empty()) {
      ++report.passes;
      report.refused_link = report.refused_meet = 0;
      const bool has_removed = visit_all(to_visit, report, progress);
      to_visit = has_removed ? survivors(to_visit) : std::vector<VertexId>{};
    }
    compact();
    return report;
  }

 private:
  [[nodiscard]] bool is_small_valence(VertexId v) const { return stars_.valence(v) == 3 || stars_.valence(v) == 4; }

  bool visit_all(const std::vector<VertexId>& vertices, RedundantPointReport& report, const ProgressCallback& progress) {
    bool has_removed = false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i % kProgressStride == 0)
        report_progress(progress, "redundant points", static_cast<double>(i) / static_cast<double>(vertices.size()));
      const std::uint32_t valence = stars_.valence(vertices[i]);
      const Verdict verdict = try_to_remove(vertices[i]);
      has_removed |= verdict == Verdict::removed;
      report.refused_link += verdict == Verdict::link_refused ? 1 : 0;
      report.refused_meet += verdict == Verdict::meeting_refused ? 1 : 0;
      if (verdict == Verdict::removed) ++(valence == 3 ? report.valence3 : report.valence4);
    }
    return has_removed;
  }

  /// What the next pass visits: those still there, and the vertices around removed ones, whose valence may have come down.
  std::vector<VertexId> survivors(const std::vector<VertexId>& visited) {
    std::vector<VertexId> next;
    for (const VertexId v : visited)
      if (is_small_valence(v)) next.push_back(v);
    for (const VertexId v : touched_)
      if (is_small_valence(v)) next.push_back(v);
    touched_.clear();
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
  }

  Verdict try_to_remove(VertexId v) {
    if (!is_small_valence(v)) return Verdict::not_redundant;
    ring_.clear();
    ring_faces_.clear();
    append_ring(mesh_, v, stars_[v], ring_, ring_faces_);
    Verdict verdict = Verdict::not_redundant;
    for (const Replacement& replacement : replacements(v)) {
      if (!keeps_manifold(replacement)) {
        verdict = Verdict::link_refused;
      } else if (meets_anything(v, replacement)) {
        verdict = Verdict::meeting_refused;
      } else {
        replace(v, replacement);
        return Verdict::removed;
      }
    }
    return verdict;
  }

  /// The replacements within the tolerance, the nearest first.
  [[nodiscard]] std::vector<Replacement> replacements(VertexId v) const {
    const double tolerance = options_.tolerance * (options_.is_tolerance_relative ? longest_spoke(v) : 1.0);
    const auto& r = ring_;
    if (r.size() == 3) {
      if (!(distance_to_ring_plane(v) < tolerance)) return {};
      return {Replacement{{Triangle{r[0], r[1], r[2]}}, 1}};
    }
    const std::array<double, 2> distance{distance_to_diagonal(v, 0), distance_to_diagonal(v, 1)};
    const std::size_t nearest = distance[1] < distance[0] ? 1 : 0;
    std::vector<Replacement> result;
    for (const std::size_t i : {nearest, 1 - nearest})
      if (distance[i] < tolerance) result.push_back({{Triangle{r[i], r[i + 1], r[i + 2]}, Triangle{r[i], r[i + 2], r[(i + 3) % 4]}}, 2});
    return result;
  }

  [[nodiscard]] double longest_spoke(VertexId v) const {
    double longest = 0;
    for (const VertexId w : ring_) longest = std::max(longest, (mesh_.points[w] - mesh_.points[v]).norm());
    return longest;
  }

  [[nodiscard]] double distance_to_ring_plane(VertexId v) const {
    const Vec3 &a = mesh_.points[ring_[0]], &b = mesh_.points[ring_[1]], &c = mesh_.points[ring_[2]];
    const Vec3 normal = doubled_area_vector(a, b, c);
    const double norm = normal.norm();
    return norm > 0 ? std::abs(normal.dot(mesh_.points[v] - a)) / norm : HUGE_VAL;
  }

  [[nodiscard]] double distance_to_diagonal(VertexId v, std::size_t i) const {
    return distance_to_open_segment(mesh_.points[v], mesh_.points[ring_[i]], mesh_.points[ring_[i + 2]]);
  }

  [[nodiscard]] bool has_neighbour(VertexId v, VertexId w) const {
    return std::any_of(stars_[v].begin(), stars_[v].end(), [&](FaceId f) {
      const Triangle& t = mesh_.triangles[f];
      return t[0] == w || t[1] == w || t[2] == w;
    });
  }

  /// The link condition: the new triangle or diagonal does not exist yet, and no vertex falls below valence 3.
  [[nodiscard]] bool keeps_manifold(const Replacement& replacement) const {
    if (replacement.count == 1) return std::all_of(ring_.begin(), ring_.end(), [&](VertexId w) { return stars_.valence(w) > 3; });
    const Triangle& t = replacement.triangles[0];  // (end of the diagonal, side, other end)
    const VertexId other_side = replacement.triangles[1][2];
    return !has_neighbour(t[0], t[2]) && stars_.valence(t[1]) > 3 && stars_.valence(other_side) > 3;
  }

  [[nodiscard]] TrianglePoints points_of(const Triangle& t) const { return {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]}; }

  [[nodiscard]] bool meets_anything(VertexId v, const Replacement& replacement) const {
    for (std::size_t i = 0; i < replacement.count; ++i) {
      const TrianglePoints p = points_of(replacement.triangles[i]);
      if (are_collinear(p[0], p[1], p[2])) return true;
    }
    const auto& [first, second] = replacement.triangles;
    if (replacement.count == 2 && triangles_meet_beyond_shared(points_of(first), first, points_of(second), second)) return true;
    Vec3 low = mesh_.points[v], high = low;
    for (const VertexId w : ring_) {
      low = low.cwiseMin(mesh_.points[w]);
      high = high.cwiseMax(mesh_.points[w]);
    }
    bool is_meeting = false;
    grid_.for_overlapping(grid_.box_of(low, high), [&](FaceId f) {
      const Triangle& t = mesh_.triangles[f];
      if (is_meeting || t[0] == v || t[1] == v || t[2] == v) return;
      is_meeting = meets_replacement(t, v, replacement);
    });
    return is_meeting;
  }

  /// Whether triangle t meets the tetrahedra between the vertex and the new triangles elsewhere than in what it shares with them.
  [[nodiscard]] bool meets_replacement(const Triangle& t, VertexId v, const Replacement& replacement) const {
    const TrianglePoints p = points_of(t);
    for (std::size_t i = 0; i < replacement.count; ++i) {
      const Triangle& s = replacement.triangles[i];
      const TrianglePoints q = points_of(s);
      if (triangles_meet_beyond_shared(p, t, q, s)) return true;
      for (int j = 0; j < 3; ++j) {
        const bool is_corner = t[j] == s[0] || t[j] == s[1] || t[j] == s[2];
        if (!is_corner && strictly_inside_tetrahedron(p[j], q[0], q[1], q[2], mesh_.points[v])) return true;
      }
    }
    if (replacement.count == 1) return false;
    const Triangle wall{v, replacement.triangles[0][0], replacement.triangles[0][2]};  // between the two tetrahedra
    return triangles_meet_beyond_shared(p, t, points_of(wall), wall);
  }

  void replace(VertexId v, const Replacement& replacement) {
    const std::vector<FaceId> old_faces(stars_[v].begin(), stars_[v].end());
    for (const FaceId f : old_faces) {
      for (const VertexId w : mesh_.triangles[f]) stars_.remove(w, f);
      grid_.remove(f);
      is_removed_[f] = 1;
    }
    for (std::size_t i = 0; i < replacement.count; ++i) {
      const FaceId f = old_faces[i];
      mesh_.triangles[f] = replacement.triangles[i];
      is_removed_[f] = 0;
      const TrianglePoints p = points_of(mesh_.triangles[f]);
      for (const VertexId w : mesh_.triangles[f]) stars_.add(w, f);
      grid_.move(f, grid_.box_of(p[0], p[1], p[2]));
    }
    touched_.insert(touched_.end(), ring_.begin(), ring_.end());
  }

  void compact() {
    std::vector<char> is_kept(is_removed_.size());
    std::transform(is_removed_.begin(), is_removed_.end(), is_kept.begin(), [](char removed) { return static_cast<char>(removed == 0); });
    keep_triangles(mesh_, is_kept);
    remove_isolated_vertices(mesh_);
  }

  TriangleMesh& mesh_;
  const RedundantPointOptions& options_;
  ShrinkingStars stars_;
  TriangleGrid grid_;
  std::vector<char> is_removed_;
  std::vector<VertexId> ring_;
  std::vector<FaceId> ring_faces_;
  std::vector<VertexId> touched_;
};

}  // namespace

RedundantPointReport remove_redundant_points(TriangleMesh& mesh, const RedundantPointOptions& options, const ProgressCallback& progress) {
  return RedundantPointRemover(mesh, options).run(progress);
}

}  // namespace smopt
