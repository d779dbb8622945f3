#include "smopt/surface/trilinear_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "smopt/surface/cell_loops.h"
#include "smopt/surface/cell_triangulation.h"
#include "smopt/surface/cell_tunnel.h"

namespace smopt {
namespace {

/// A vertex keeps this distance from the ends of its edge, in edges, so that it is strictly inside: a node whose value is the
/// isovalue would else be the place of up to six vertices.
constexpr double kLeastParameter = 1e-6;

/// Coordinates up to this many spacings from the origin resolve the least parameter by at least 16 steps of a double.
constexpr double kFarthestInSpacings = kLeastParameter / (16 * std::numeric_limits<double>::epsilon());

/// Vertex numbers are 32-bit.
constexpr std::size_t kMostVertices = std::numeric_limits<VertexId>::max();

void check_grid(const ScalarGrid& grid) {
  if (grid.values.size() != grid.node_count()) throw InvalidInput("a grid's number of values is not that of its nodes");
  for (int axis = 0; axis < 3; ++axis) {
    const double farthest = std::max(std::abs(grid.origin[axis]), std::abs(grid.coordinate(axis, grid.size[axis])));
    if (!(farthest <= kFarthestInSpacings * grid.spacing))
      throw InvalidInput(
          fmt::format("a grid of spacing {} cannot be resolved at a distance of {} from the origin", grid.spacing, farthest));
  }
}

/// Sweeps the grid layer by layer (constant z); keeps the vertices of two layers and of the edges between them.
class SurfaceSweep {
 public:
  SurfaceSweep(const ScalarGrid& grid, double isovalue)
      : grid_(grid), isovalue_(isovalue), nx_(grid.size[0]), ny_(grid.size[1]), nz_(grid.size[2]) {
    for (auto& layer : x_edges_) layer.resize(nx_ * ny_);
    for (auto& layer : y_edges_) layer.resize(nx_ * ny_);
    z_edges_.resize(nx_ * ny_);
  }

  TriangleMesh run(TrilinearSurfaceReport& report, const ProgressCallback& progress) {
    for (std::size_t k = 0; k < nz_; ++k) {
      report_progress(progress, "surface", static_cast<double>(k) / static_cast<double>(nz_));
      check_layer(k);
      place_vertices_in_layer(k);
      if (k == 0) continue;
      place_vertices_between(k - 1);
      for (std::size_t j = 0; j + 1 < ny_; ++j) mesh_row(j, k - 1);
    }
    report = report_;
    return std::move(mesh_);
  }

 private:
  /// A node's value relative to the isovalue; the sign of the difference of two doubles is exact.
  [[nodiscard]] double value(std::size_t node) const { return grid_.values[node] - isovalue_; }
  [[nodiscard]] bool inside(std::size_t node) const { return is_inside(value(node)); }
  [[nodiscard]] std::size_t layer_size() const { return nx_ * ny_; }

  void check_layer(std::size_t k) const {
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        const std::size_t node = grid_.index(i, j, k);
        if (!std::isfinite(grid_.values[node]))
          throw InvalidInput(fmt::format("the value at grid node ({}, {}, {}) is not finite", i, j, k));
        const bool outermost = i == 0 || j == 0 || k == 0 || i + 1 == nx_ || j + 1 == ny_ || k + 1 == nz_;
        if (outermost && inside(node))
          throw InvalidInput(fmt::format("the surface leaves the grid at its outermost node ({}, {}, {})", i, j, k));
      }
    }
  }

  void place_vertices_in_layer(std::size_t k) {
    std::vector<VertexId>& x_edges = x_edges_[k % 2];
    std::vector<VertexId>& y_edges = y_edges_[k % 2];
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        const std::size_t node = grid_.index(i, j, k);
        const bool is_in = inside(node);
        if (i + 1 < nx_ && is_in != inside(node + 1)) x_edges[j * nx_ + i] = add_vertex(0, {i, j, k}, node, node + 1);
        if (j + 1 < ny_ && is_in != inside(node + nx_)) y_edges[j * nx_ + i] = add_vertex(1, {i, j, k}, node, node + nx_);
      }
    }
  }

  void place_vertices_between(std::size_t k) {
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        const std::size_t node = grid_.index(i, j, k);
        const std::size_t above = node + layer_size();
        if (inside(node) != inside(above)) z_edges_[j * nx_ + i] = add_vertex(2, {i, j, k}, node, above);
      }
    }
  }

  VertexId add_vertex(int axis, const std::array<std::size_t, 3>& at, std::size_t node, std::size_t next) {
    Vec3 position(grid_.coordinate(0, at[0]), grid_.coordinate(1, at[1]), grid_.coordinate(2, at[2]));
    const double low = value(node);
    const double t = std::clamp(low / (low - value(next)), kLeastParameter, 1 - kLeastParameter);
    position[axis] += t * (grid_.coordinate(axis, at[axis] + 1) - position[axis]);
    return add_point(position);
  }

  VertexId add_point(const Vec3& position) {
    if (mesh_.points.size() >= kMostVertices) throw InvalidInput("the surface has more vertices than 32-bit indices can number");
    mesh_.points.push_back(position);
    return static_cast<VertexId>(mesh_.points.size() - 1);
  }

  void mesh_row(std::size_t j, std::size_t k) {
    const std::size_t row = grid_.index(0, j, k);
    unsigned mask = inside_of_column(row) << 1;
    for (std::size_t i = 0; i + 1 < nx_; ++i) {
      mask = (mask >> 1 & kLowX) | inside_of_column(row + i + 1) << 1;
      if (mask == kNoneInside || mask == kAllInside) continue;
      mesh_cell(i, j, k);
    }
  }

  static constexpr unsigned kNoneInside = 0;
  static constexpr unsigned kAllInside = 0xff;
  static constexpr unsigned kLowX = 0x55;  ///< the corners with x = 0

  /// The four nodes of a cell at one x: their bits at the places of the corners with x = 0.
  [[nodiscard]] unsigned inside_of_column(std::size_t node) const {
    const std::size_t above = node + layer_size();
    return unsigned{inside(node)} | unsigned{inside(node + nx_)} << 2 | unsigned{inside(above)} << 4 | unsigned{inside(above + nx_)} << 6;
  }

  void mesh_cell(std::size_t i, std::size_t j, std::size_t k) {
    const cube::CornerValues values = corner_values(grid_.index(i, j, k));
    const CellLoops loops = trace_cell_loops(values);
    std::optional<Tunnel> tunnel = find_tunnel(values, loops);
    if (tunnel) move_to_cell(tunnel->waist, {i, j, k});
    collect_vertices(loops, i, j, k % 2);
    triangulate_cell(positions_, loops, tunnel, patch_);
    append_patch();
    ++report_.surface_cells;
    if (loops.ambiguous_faces != 0 || loops.count > 1) ++report_.ambiguous_cells;
    if (tunnel) ++report_.tunnel_cells;
  }

  [[nodiscard]] cube::CornerValues corner_values(std::size_t node) const {
    cube::CornerValues values;
    for (int corner = 0; corner < cube::kCorners; ++corner)
      values[corner] = value(node + (corner & 1) + (corner >> 1 & 1) * nx_ + (corner >> 2) * layer_size());
    return values;
  }

  void move_to_cell(std::array<Vec3, 6>& points, const std::array<std::size_t, 3>& cell) const {
    for (Vec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) {
        const double low = grid_.coordinate(axis, cell[axis]);
        p[axis] = low + p[axis] * (grid_.coordinate(axis, cell[axis] + 1) - low);
      }
    }
  }

  /// Looks up the vertices on the cell's edges; `parity` is that of its lower layer.
  void collect_vertices(const CellLoops& loops, std::size_t i, std::size_t j, std::size_t parity) {
    for (int n = 0; n < loops.begin[loops.count]; ++n) {
      const int edge = loops.edges[n];
      const int low = cube::low_corner(edge);
      const std::size_t at = (j + (low >> 1 & 1)) * nx_ + i + (low & 1);
      const std::size_t layer = (parity + (low >> 2)) % 2;
      const int axis = cube::axis_of_edge(edge);
      ids_[edge] = axis == 0 ? x_edges_[layer][at] : axis == 1 ? y_edges_[layer][at] : z_edges_[at];
      positions_[edge] = mesh_.points[ids_[edge]];
    }
  }

  void append_patch() {
    for (std::size_t i = cube::kEdges; i < patch_.points.size(); ++i) ids_[i] = add_point(patch_.points[i]);
    report_.interior_vertices += patch_.interior_points();
    for (const auto& [a, b, c] : patch_.triangles) mesh_.triangles.push_back({ids_[a], ids_[b], ids_[c]});
  }

  const ScalarGrid& grid_;
  double isovalue_;
  std::size_t nx_, ny_, nz_;
  std::array<std::vector<VertexId>, 2> x_edges_;
  std::array<std::vector<VertexId>, 2> y_edges_;
  std::vector<VertexId> z_edges_;
  std::array<Vec3, cube::kEdges> positions_;
  std::array<VertexId, CellPatch::kMaxPoints> ids_{};
  CellPatch patch_;
  TriangleMesh mesh_;
  TrilinearSurfaceReport report_;
};

}  // namespace

TriangleMesh trilinear_surface(const ScalarGrid& grid, double isovalue, TrilinearSurfaceReport* report, const ProgressCallback& progress) {
  check_grid(grid);
  TrilinearSurfaceReport met;
  TriangleMesh mesh = SurfaceSweep(grid, isovalue).run(met, progress);
  if (report) *report = met;
  return mesh;
}

}  // namespace smopt
