#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "smopt/improve/remesh/deviation_bound.h"
#include "smopt/improve/remesh/editable_surface.h"
#include "smopt/improve/remesh/remesh.h"
#include "smopt/improve/remesh/triangle_quality.h"
#include "smopt/improve/remesh/volume_ledger.h"

namespace smopt {

/// Numbers put aside for the vertices that a sweep may add: one vertex and two triangles for each vertex visited. Vertices that
/// are not visited share the first's, to try out what would become of a split.
class SpareNumbers {
 public:
  void take(EditableSurface& surface, const std::vector<VertexId>& visited) {
    spare_ = surface.reserve(visited.size());
    index_.assign(surface.mesh().vertex_count(), 0);
    for (std::uint32_t i = 0; i < visited.size(); ++i) index_[visited[i]] = i;
  }
  [[nodiscard]] VertexId vertex(VertexId visited) const { return spare_.vertices[index_[visited]]; }
  [[nodiscard]] std::array<FaceId, 2> faces(VertexId visited) const {
    return {spare_.faces[2 * std::size_t{index_[visited]}], spare_.faces[2 * std::size_t{index_[visited]} + 1]};
  }

 private:
  EditableSurface::Spare spare_;
  std::vector<std::uint32_t> index_;  // per vertex of the surface
};

/// What all that takes part in remeshing shares.
struct RemeshState {
  RemeshState(const TriangleMesh& mesh, const RemeshOptions& given)
      : options(given), quality(given.goals), surface(mesh), ledger(mesh.vertex_count()), is_touched(mesh.vertex_count(), 0) {}

  void grow() {
    const std::size_t vertices = surface.mesh().vertex_count();
    sizes.resize(vertices, 0);
    ledger.grow(vertices);
    is_touched.resize(vertices, 0);
  }
  [[nodiscard]] double quality_of(const Triangle& t) const {
    return quality.of_triangle(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
  }
  /// The edge's length, by what it should be.
  [[nodiscard]] double relative_length(VertexId v, VertexId w) const {
    return (surface.point(v) - surface.point(w)).norm() / (0.5 * (sizes[v] + sizes[w]));
  }
  /// Above (below) 6.
  [[nodiscard]] int excess(VertexId v) const { return static_cast<int>(surface.valence(v)) - 6; }

  const RemeshOptions& options;
  TriangleQuality quality;
  EditableSurface surface;
  std::vector<double> sizes;  ///< per vertex: how long edges are to be, Å
  VolumeLedger ledger;
  std::vector<char> is_touched;  ///< per vertex: whether its star changed since this was cleared
  SpareNumbers spare;
  std::optional<DeviationBound> bound;
};

}  // namespace smopt
