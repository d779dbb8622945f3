#include "smopt/improve/redundant_points.h"

#include <algorithm>
#include <unordered_set>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "smopt/improve/regional_grid.h"
#include "smopt/improve/shrinking_stars.h"
#include "smopt/improve/star_replacement.h"
#include "smopt/improve/visit_order.h"
#include "smopt/mesh/compact.h"
#include "smopt/mesh/rings.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Vertices between two progress reports.
constexpr std::size_t kProgressStride = 65536;

enum class Verdict { not_redundant, link_refused, meeting_refused, removed };

/// The box of a vertex and its ring, which its star and all replacements lie in.
Extent extent_of(const TriangleMesh& mesh, VertexId v, std::span<const VertexId> ring) {
  Extent extent{mesh.points[v], mesh.points[v]};
  for (const VertexId w : ring) {
    extent.low = extent.low.cwiseMin(mesh.points[w]);
    extent.high = extent.high.cwiseMax(mesh.points[w]);
  }
  return extent;
}

/// A pass visits the vertices that have valence 3 or 4 when it begins, in ascending order. Of these it leaves out those that are as they
/// were when they were found not to be redundant: not redundant depends on a vertex's own star only. What is near a redundant vertex may
/// have changed; it is visited in every pass.
class RedundantPointRemover {
 public:
  RedundantPointRemover(TriangleMesh& mesh, const RedundantPointOptions& options)
      : mesh_(mesh), options_(options), stars_(mesh), is_removed_(mesh.triangle_count(), 0), nearby_(mesh, is_removed_) {}

  RedundantPointReport run(const ProgressCallback& progress) {
    find_first_candidates();
    bool has_removed = true;
    while (has_removed && small_vertices_ > 0) {
      ++report_.passes;
      report_.refused_link = report_.refused_meet = 0;
      has_removed = run_pass(progress);
    }
    compact();
    return report_;
  }

 private:
  [[nodiscard]] bool is_small(VertexId v) const { return stars_.valence(v) == 3 || stars_.valence(v) == 4; }

  /// Counts the vertices of valence 3 and 4 and finds the redundant ones among them, on all threads.
  void find_first_candidates() {
    struct Found {
      std::size_t small = 0;
      std::vector<VertexId> candidates;
      std::vector<Extent> extents;
      std::vector<VertexId> ring;
      std::vector<FaceId> ring_faces;
    };
    tbb::enumerable_thread_specific<Found> found_by_thread;
    for_ranges_in_parallel(mesh_.vertex_count(), [&](std::size_t begin, std::size_t end) {
      Found& found = found_by_thread.local();
      for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
        if (!is_small(v)) continue;
        ++found.small;
        found.ring.clear();
        found.ring_faces.clear();
        append_ring(mesh_, v, stars_[v], found.ring, found.ring_faces);
        if (replacements_within_tolerance(mesh_, v, found.ring, options_).count == 0) continue;
        found.candidates.push_back(v);
        found.extents.push_back(extent_of_neighbours(found.ring));
      }
    });
    std::vector<Extent> extents;
    for (const Found& found : found_by_thread) {
      small_vertices_ += found.small;
      next_.insert(next_.end(), found.candidates.begin(), found.candidates.end());
      extents.insert(extents.end(), found.extents.begin(), found.extents.end());
    }
    nearby_.expect(std::move(extents));
  }

  /// The box of the stars of a ring's vertices: where the vertex itself and, once it is gone, those of its ring look for other triangles.
  [[nodiscard]] Extent extent_of_neighbours(std::span<const VertexId> ring) const {
    Extent extent = extent_of(mesh_, ring.front(), ring);
    for (const VertexId w : ring)
      for (const FaceId f : stars_[w]) {
        const Extent triangle = extent_of(mesh_, w, mesh_.triangles[f]);
        extent = {extent.low.cwiseMin(triangle.low), extent.high.cwiseMax(triangle.high)};
      }
    return extent;
  }

  /// Whether anything was removed.
  bool run_pass(const ProgressCallback& progress) {
    order_ = VisitOrder(std::exchange(next_, {}));
    became_small_.clear();
    report_progress(progress, "redundant points", 0);
    bool has_removed = false;
    std::size_t visited = 0;
    while (const std::optional<VertexId> v = order_.next()) {
      if (++visited % kProgressStride == 0) report_progress(progress, "redundant points", order_.fraction_done());
      has_removed |= visit(*v) == Verdict::removed;
    }
    return has_removed;
  }

  Verdict visit(VertexId v) {
    const std::uint32_t valence = stars_.valence(v);
    const Verdict verdict = try_to_remove(v);
    if (verdict == Verdict::removed) ++(valence == 3 ? report_.valence3 : report_.valence4);
    if (verdict == Verdict::link_refused || verdict == Verdict::meeting_refused) {
      ++(verdict == Verdict::link_refused ? report_.refused_link : report_.refused_meet);
      next_.push_back(v);
    }
    return verdict;
  }

  Verdict try_to_remove(VertexId v) {
    if (!is_small(v)) return Verdict::not_redundant;
    ring_.clear();
    ring_faces_.clear();
    append_ring(mesh_, v, stars_[v], ring_, ring_faces_);
    Verdict verdict = Verdict::not_redundant;
    const StarReplacements replacements = replacements_within_tolerance(mesh_, v, ring_, options_);
    for (const StarReplacement& replacement : replacements.all()) {
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

  [[nodiscard]] bool has_neighbour(VertexId v, VertexId w) const {
    return std::ranges::any_of(stars_[v], [&](FaceId f) { return std::ranges::count(mesh_.triangles[f], w) > 0; });
  }

  /// The link condition: the new triangle or diagonal does not exist yet, and no vertex falls below valence 3.
  [[nodiscard]] bool keeps_manifold(const StarReplacement& replacement) const {
    if (replacement.count == 1) return std::ranges::all_of(ring_, [&](VertexId w) { return stars_.valence(w) > 3; });
    const Triangle& t = replacement.triangles[0];
    const VertexId other_side = replacement.triangles[1][2];
    return !has_neighbour(t[0], t[2]) && stars_.valence(t[1]) > 3 && stars_.valence(other_side) > 3;
  }

  [[nodiscard]] bool meets_anything(VertexId v, const StarReplacement& replacement) {
    if (is_degenerate(mesh_, replacement)) return true;
    bool is_meeting = false;
    nearby_.for_overlapping(extent_of(mesh_, v, ring_), [&](FaceId f) {
      if (!is_meeting && std::ranges::count(mesh_.triangles[f], v) == 0) is_meeting = meets_replacement(mesh_, f, v, replacement);
    });
    return is_meeting;
  }

  /// \pre `meets_anything` was asked.
  void replace(VertexId v, const StarReplacement& replacement) {
    std::vector<char> was_small(ring_.size());
    std::ranges::transform(ring_, was_small.begin(), [&](VertexId w) { return static_cast<char>(is_small(w)); });
    const std::vector<FaceId> old_faces(stars_[v].begin(), stars_[v].end());
    for (const FaceId f : old_faces) {
      for (const VertexId w : mesh_.triangles[f]) stars_.remove(w, f);
      nearby_.remove(f);
      is_removed_[f] = 1;
    }
    for (std::size_t i = 0; i < replacement.count; ++i) {
      const FaceId f = old_faces[i];
      mesh_.triangles[f] = replacement.triangles[i];
      is_removed_[f] = 0;
      for (const VertexId w : mesh_.triangles[f]) stars_.add(w, f);
      nearby_.move(f);
    }
    --small_vertices_;
    for (std::size_t i = 0; i < ring_.size(); ++i) plan_changed(ring_[i], was_small[i] != 0, v);
  }

  /// When vertex w is visited whose star changed as `visited` was removed: in this pass if it is one of the pass's and its turn is to come.
  void plan_changed(VertexId w, bool was_small, VertexId visited) {
    if (!is_small(w)) return;
    if (!was_small) {
      ++small_vertices_;
      became_small_.insert(w);
    }
    if (w > visited && !became_small_.contains(w))
      order_.add(w);
    else
      next_.push_back(w);
  }

  void compact() {
    std::vector<char> is_kept(is_removed_.size());
    std::ranges::transform(is_removed_, is_kept.begin(), [](char removed) { return static_cast<char>(removed == 0); });
    keep_triangles(mesh_, is_kept);
    remove_isolated_vertices(mesh_);
  }

  TriangleMesh& mesh_;
  const RedundantPointOptions& options_;
  RedundantPointReport report_;
  ShrinkingStars stars_;
  std::vector<char> is_removed_;  // per triangle
  RegionalGrid nearby_;
  std::size_t small_vertices_ = 0;             // of valence 3 or 4, not removed
  VisitOrder order_{{}};                       // of this pass
  std::vector<VertexId> next_;                 // what the next pass begins with
  std::unordered_set<VertexId> became_small_;  // in this pass
  std::vector<VertexId> ring_;
  std::vector<FaceId> ring_faces_;
};

}  // namespace

RedundantPointReport remove_redundant_points(TriangleMesh& mesh, const RedundantPointOptions& options, const ProgressCallback& progress) {
  return RedundantPointRemover(mesh, options).run(progress);
}

}  // namespace smopt
