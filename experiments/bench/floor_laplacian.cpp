#include "experiments/bench/floor_laplacian.h"

#include <algorithm>

namespace smopt::bench {
namespace {

/// Additions that every vertex gets. 95 % of the vertices of a marching-cubes surface have at most eight neighbours; seven or nine are slower.
constexpr std::uint32_t kSlots = 8;

/// No vertex of a closed manifold has fewer neighbours.
constexpr std::uint32_t kSmallestValence = 3;

}  // namespace

FloorLaplacian::FloorLaplacian(const TriangleMesh& mesh)
    : offsets_(mesh.vertex_count() + 1, 0), neighbours_(3 * mesh.triangle_count() + kSlots, 0) {
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) ++offsets_[v + 1];
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) offsets_[v + 1] += offsets_[v];
  std::vector<std::uint32_t> end(offsets_.begin(), offsets_.end() - 1);
  // Each neighbour follows its vertex in exactly one triangle of a closed, oriented manifold.
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) neighbours_[end[t[i]]++] = t[(i + 1) % 3];
  std::uint32_t largest = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) largest = std::max(largest, offsets_[v + 1] - offsets_[v]);
  reciprocals_.assign(largest + 1, 0.0);
  for (std::uint32_t k = 1; k <= largest; ++k) reciprocals_[k] = 1.0 / k;
  reset(mesh);
}

void FloorLaplacian::reset(const TriangleMesh& mesh) {
  points_ = mesh.points;
  points_.emplace_back(Vec3::Zero());
  next_ = points_;
}

void FloorLaplacian::run(int rounds, Loop loop) {
  for (int round = 0; round < rounds; ++round) {
    if (loop == Loop::branchless)
      sweep_branchless();
    else
      sweep_straightforward();
    points_.swap(next_);
  }
}

void FloorLaplacian::sweep_branchless() {
  const auto origin = static_cast<VertexId>(points_.size() - 1);
  const Vec3* const from = points_.data();
  const VertexId* row = neighbours_.data();
  for (VertexId v = 0; v < origin; ++v) {
    const std::uint32_t valence = offsets_[v + 1] - offsets_[v];
    double x = 0, y = 0, z = 0;
    for (std::uint32_t i = 0; i < kSmallestValence; ++i) {
      const Vec3& p = from[row[i]];
      x += p.x(), y += p.y(), z += p.z();
    }
    for (std::uint32_t i = kSmallestValence; i < kSlots; ++i) {
      const std::uint32_t is_in_row = 0U - static_cast<std::uint32_t>(i < valence);  // all bits or none
      const Vec3& p = from[(row[i] & is_in_row) | (origin & ~is_in_row)];
      x += p.x(), y += p.y(), z += p.z();
    }
    for (std::uint32_t i = kSlots; i < valence; ++i) {
      const Vec3& p = from[row[i]];
      x += p.x(), y += p.y(), z += p.z();
    }
    const double reciprocal = reciprocals_[valence];
    next_[v] = {x * reciprocal, y * reciprocal, z * reciprocal};
    row += valence;
  }
}

void FloorLaplacian::sweep_straightforward() {
  const auto vertices = static_cast<VertexId>(points_.size() - 1);
  for (VertexId v = 0; v < vertices; ++v) {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = offsets_[v]; i < offsets_[v + 1]; ++i) sum += points_[neighbours_[i]];
    next_[v] = sum * reciprocals_[offsets_[v + 1] - offsets_[v]];
  }
}

}  // namespace smopt::bench
