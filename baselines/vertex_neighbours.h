#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// The neighbours of each vertex of any triangle mesh, each once, as one flat array (compressed rows): what `meshconn` of ISO2mesh gives.
struct VertexNeighbours {
  std::vector<std::uint32_t> offsets;  ///< vertex_count + 1 entries
  std::vector<VertexId> neighbours;    ///< within a row in the order in which the vertex's triangles name them; kSlots more at the end

  /// Additions that each mean costs: 95 % of the vertices of a marching-cubes surface have at most eight neighbours.
  static constexpr std::uint32_t kSlots = 8;

  [[nodiscard]] std::size_t vertex_count() const { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const VertexId> operator[](std::size_t v) const {
    return {neighbours.data() + offsets[v], neighbours.data() + offsets[v + 1]};
  }
};

/// A vertex without triangles has no neighbours. Cost: O(n).
VertexNeighbours build_neighbours(const TriangleMesh& mesh);

/// A copy of one value a vertex with a zero behind the last, as `NeighbourMeans` needs it.
inline std::vector<Vec3> with_zero_behind(const std::vector<Vec3>& values) {
  std::vector<Vec3> result;
  result.reserve(values.size() + 1);
  result.assign(values.begin(), values.end());
  result.emplace_back(Vec3::Zero());
  return result;
}

/// The means of the neighbours' values. Made anew for each range of vertices: what the loops read is then in registers.
///
/// Each mean is a fixed number of additions, past the row's end of a zero: where a row ends is hard to predict, and a loop that asks takes
/// twice the time.
class NeighbourMeans {
 public:
  /// \pre behind the vertices' values stands a zero (`with_zero_behind`). Both are referred to.
  NeighbourMeans(const VertexNeighbours& neighbours, const std::vector<Vec3>& values)
      : offsets_(neighbours.offsets.data()),
        neighbours_(neighbours.neighbours.data()),
        values_(values.data()),
        zero_(static_cast<VertexId>(values.size() - 1)) {}

  [[nodiscard]] bool exists(std::size_t v) const { return offsets_[v + 1] != offsets_[v]; }

  /// \pre exists(v)
  [[nodiscard]] Vec3 of(std::size_t v) const {
    const VertexId* const row = neighbours_ + offsets_[v];
    const std::uint32_t valence = offsets_[v + 1] - offsets_[v];
    double x = 0, y = 0, z = 0;
    for (std::uint32_t i = 0; i < VertexNeighbours::kSlots; ++i) {
      const std::uint32_t is_in_row = 0U - static_cast<std::uint32_t>(i < valence);  // all bits or none
      const Vec3& p = values_[(row[i] & is_in_row) | (zero_ & ~is_in_row)];
      x += p.x(), y += p.y(), z += p.z();
    }
    for (std::uint32_t i = VertexNeighbours::kSlots; i < valence; ++i) {
      const Vec3& p = values_[row[i]];
      x += p.x(), y += p.y(), z += p.z();
    }
    const double reciprocal = 1.0 / valence;
    return {x * reciprocal, y * reciprocal, z * reciprocal};
  }

 private:
  const std::uint32_t* offsets_;
  const VertexId* neighbours_;
  const Vec3* values_;
  VertexId zero_;
};

}  // namespace smopt::baselines
