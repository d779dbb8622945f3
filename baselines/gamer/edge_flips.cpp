#include "baselines/gamer/edge_flips.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "smopt/geometry/triangle_shape.h"

namespace smopt::baselines {
namespace {

// GAMer 2's own numbers (checkFlipAngle).
constexpr double kLargestAreaGrowth = 1.001;  ///< of the square of the area
constexpr int kMuchBetterValence = -3;        ///< change of the sum of the squares of (valence − 6): below this flip anyway
constexpr int kMuchWorseValence = 3;          ///< above this do not
constexpr int kLockedSteps = 2;               ///< triangles as far from the flipped ones have their edges locked

/// The edge (u, w) and its triangles: `left` = (u, w, next) and `right` = (u, previous, w).
struct Edge {
  VertexId u, w, next, previous;
  FaceId left, right;
};

int square(int x) {
  return x * x;
}

class Flipper {
 public:
  Flipper(TriangleMesh& mesh, const VertexRings& rings) : mesh_(mesh), rings_(rings), is_locked_(mesh.triangle_count(), false) {}

  std::size_t run() {
    for (VertexId u = 0; u < rings_.vertex_count(); ++u)
      for (std::size_t i = 0; i < rings_.valence(u); ++i)
        if (rings_.vertices(u)[i] > u) consider(edge_at(u, i));
    for (const Edge& edge : chosen_) flip(edge);
    return chosen_.size();
  }

 private:
  [[nodiscard]] Edge edge_at(VertexId u, std::size_t i) const {
    const auto ring = rings_.vertices(u);
    const auto faces = rings_.faces(u);
    const std::size_t before = (i + ring.size() - 1) % ring.size(), after = (i + 1) % ring.size();
    return {u, ring[i], ring[after], ring[before], faces[i], faces[before]};
  }

  void consider(const Edge& edge) {
    if (is_locked_[edge.left] || is_locked_[edge.right] || !may_flip(edge) || !should_flip(edge)) return;
    chosen_.push_back(edge);
    new_edges_.insert(new_edge(edge));
    lock_around(edge);
  }

  /// Whether the mesh stays a manifold: the new edge is neither there nor about to be.
  [[nodiscard]] bool may_flip(const Edge& edge) const {
    const auto ring = rings_.vertices(edge.next);
    return std::find(ring.begin(), ring.end(), edge.previous) == ring.end() && !new_edges_.contains(new_edge(edge));
  }
  static std::pair<VertexId, VertexId> new_edge(const Edge& edge) { return std::minmax({edge.next, edge.previous}); }

  [[nodiscard]] bool should_flip(const Edge& edge) const {
    const double before = area(edge.u, edge.w, edge.next) + area(edge.u, edge.previous, edge.w);
    const double after = area(edge.u, edge.previous, edge.next) + area(edge.previous, edge.w, edge.next);
    if (after * after > kLargestAreaGrowth * before * before) return false;
    const int change = valence_change(edge);
    if (change < kMuchBetterValence || change > kMuchWorseValence) return change < 0;
    return std::min(sharpness(edge.u, edge.previous, edge.next), sharpness(edge.previous, edge.w, edge.next)) >
           std::min(sharpness(edge.u, edge.w, edge.next), sharpness(edge.u, edge.previous, edge.w));
  }

  [[nodiscard]] int valence_change(const Edge& edge) const {
    int change = 0;
    for (const VertexId v : {edge.u, edge.w}) change += square(excess(v) - 1) - square(excess(v));
    for (const VertexId v : {edge.next, edge.previous}) change += square(excess(v) + 1) - square(excess(v));
    return change;
  }
  [[nodiscard]] int excess(VertexId v) const { return static_cast<int>(rings_.valence(v)) - 6; }

  [[nodiscard]] double area(VertexId a, VertexId b, VertexId c) const {
    return doubled_area_vector(mesh_.points[a], mesh_.points[b], mesh_.points[c]).norm();
  }
  /// Grows with the smallest angle.
  [[nodiscard]] double sharpness(VertexId a, VertexId b, VertexId c) const {
    return squared_sine_of_smallest_angle(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
  }

  void lock_around(const Edge& edge) {
    std::vector<FaceId> faces = {edge.left, edge.right};
    for (int step = 0; step < kLockedSteps; ++step) {
      const std::size_t end = faces.size();
      for (std::size_t i = 0; i < end; ++i) add_neighbours(faces[i], faces);
    }
    for (const FaceId f : faces) is_locked_[f] = true;
  }

  /// The triangles beyond the three edges of f.
  void add_neighbours(FaceId f, std::vector<FaceId>& faces) const {
    for (const VertexId u : mesh_.triangles[f]) {
      const auto around = rings_.faces(u);
      const auto at = static_cast<std::size_t>(std::find(around.begin(), around.end(), f) - around.begin());
      faces.push_back(around[(at + 1) % around.size()]);
    }
  }

  void flip(const Edge& edge) {
    mesh_.triangles[edge.left] = {edge.previous, edge.w, edge.next};
    mesh_.triangles[edge.right] = {edge.u, edge.previous, edge.next};
  }

  TriangleMesh& mesh_;
  const VertexRings& rings_;
  std::vector<char> is_locked_;
  std::vector<Edge> chosen_;
  std::set<std::pair<VertexId, VertexId>> new_edges_;
};

}  // namespace

std::size_t flip_edges(TriangleMesh& mesh, const VertexRings& rings) {
  return Flipper(mesh, rings).run();
}

}  // namespace smopt::baselines
