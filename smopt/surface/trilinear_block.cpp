#include "smopt/surface/trilinear_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "smopt/surface/cell_loops.h"
#include "smopt/surface/cell_triangulation.h"
#include "smopt/surface/cell_tunnel.h"
#include "smopt/surface/plain_cells.h"

namespace smopt {
namespace {

/// Coordinates up to this many spacings from the origin resolve the least parameter by at least 16 steps of a double.
constexpr double kFarthestInSpacings = kLeastParameter / (16 * std::numeric_limits<double>::epsilon());

/// Vertex numbers are 32-bit.
constexpr std::size_t kMostVertices = std::numeric_limits<VertexId>::max();

constexpr std::size_t kBitsPerWord = 64;

/// Which nodes of a layer (constant z) are inside, one bit a node; rows are padded with zeros.
class LayerSigns {
 public:
  LayerSigns(std::size_t nx, std::size_t ny) : nx_(nx), words_per_row_(nx / kBitsPerWord + 2), words_(ny * words_per_row_) {}

  void read(const double* values, double isovalue) {
    for (std::size_t at = 0; at < words_.size(); at += words_per_row_) {
      for (std::size_t begin = 0; begin < nx_; begin += kBitsPerWord)
        words_[at + begin / kBitsPerWord] = signs_of(values + begin, std::min(kBitsPerWord, nx_ - begin), isovalue);
      values += nx_;
    }
  }

  /// The nodes from 64·word on.
  [[nodiscard]] std::uint64_t nodes(std::size_t row, std::size_t word) const { return words_[row * words_per_row_ + word]; }
  /// Their neighbours in direction x.
  [[nodiscard]] std::uint64_t next_nodes(std::size_t row, std::size_t word) const {
    const std::size_t at = row * words_per_row_ + word;
    return words_[at] >> 1 | words_[at + 1] << (kBitsPerWord - 1);
  }

 private:
  static std::uint64_t signs_of(const double* values, std::size_t count, double isovalue) {
    std::uint64_t signs = 0;
    for (std::size_t i = 0; i < count; ++i) signs |= std::uint64_t{is_inside(values[i] - isovalue)} << i;
    return signs;
  }

  std::size_t nx_;
  std::size_t words_per_row_;  // at least one of them only padding
  std::vector<std::uint64_t> words_;
};

/// Sweeps the block layer by layer; keeps the signs of two layers and the vertices on their edges and on the edges between them.
class BlockSweep {
 public:
  BlockSweep(const ScalarGrid& grid, double isovalue, BlockMesh& mesh)
      : grid_(grid),
        isovalue_(isovalue),
        nx_(grid.size[0]),
        ny_(grid.size[1]),
        nz_(grid.size[2]),
        signs_{LayerSigns(nx_, ny_), LayerSigns(nx_, ny_)},
        mesh_(mesh) {
    for (std::vector<VertexId>& numbers : edges_of_layers_) numbers.resize(nx_ * ny_);
    mesh_.points.clear();
    mesh_.triangles.clear();
    mesh_.shared.clear();
  }

  TrilinearSurfaceReport run(const ProgressCallback& progress) {
    for (std::size_t k = 0; k < nz_; ++k) {
      report_progress(progress, "surface", static_cast<double>(k) / static_cast<double>(nz_));
      signs_[k % 2].read(&grid_.values[grid_.index(0, 0, k)], isovalue_);
      place_vertices_in_layer(k);
      if (k == 0) continue;
      place_vertices_between(k - 1);
      enter_layer(k - 1);
      for (std::size_t j = 0; j + 1 < ny_; ++j) mesh_row(j, k - 1);
    }
    return report_;
  }

 private:
  using Node = std::array<std::size_t, 3>;

  /// Which vertices: on edges along x of the two layers, along y of the two, and along z between them.
  static constexpr std::size_t kAlongX = 0;
  static constexpr std::size_t kAlongY = 2;
  static constexpr std::size_t kAlongZ = 4;
  static constexpr std::size_t kEdgeKinds = 5;

  [[nodiscard]] double value(std::size_t node) const { return grid_.values[node] - isovalue_; }

  /// The bits below the number of nodes (or cells) that a row has from 64·word on.
  [[nodiscard]] static std::uint64_t bits_below(std::size_t count, std::size_t word) {
    const std::size_t left = count - word * kBitsPerWord;
    return left >= kBitsPerWord ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
  }

  /// Calls visit(i) for all bits of bits(word) among the first `count` of a row.
  template <class Bits, class Visit>
  static void for_each_bit(std::size_t count, const Bits& bits, const Visit& visit) {
    for (std::size_t word = 0; word * kBitsPerWord < count; ++word) {
      for (std::uint64_t left = bits(word) & bits_below(count, word); left != 0; left &= left - 1)
        visit(word * kBitsPerWord + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }

  void place_vertices_in_layer(std::size_t k) {
    const LayerSigns& signs = signs_[k % 2];
    std::vector<VertexId>& along_x = edges_of_layers_[kAlongX + k % 2];
    std::vector<VertexId>& along_y = edges_of_layers_[kAlongY + k % 2];
    for (std::size_t j = 0; j < ny_; ++j) {
      const auto changes_in_x = [&](std::size_t word) { return signs.nodes(j, word) ^ signs.next_nodes(j, word); };
      for_each_bit(nx_ - 1, changes_in_x, [&](std::size_t i) { along_x[j * nx_ + i] = add_vertex(0, {i, j, k}); });
      if (j + 1 == ny_) break;
      const auto changes_in_y = [&](std::size_t word) { return signs.nodes(j, word) ^ signs.nodes(j + 1, word); };
      for_each_bit(nx_, changes_in_y, [&](std::size_t i) { along_y[j * nx_ + i] = add_vertex(1, {i, j, k}); });
    }
  }

  void place_vertices_between(std::size_t k) {
    std::vector<VertexId>& along_z = edges_of_layers_[kAlongZ];
    for (std::size_t j = 0; j < ny_; ++j) {
      const auto changes_in_z = [&](std::size_t word) { return signs_[0].nodes(j, word) ^ signs_[1].nodes(j, word); };
      for_each_bit(nx_, changes_in_z, [&](std::size_t i) { along_z[j * nx_ + i] = add_vertex(2, {i, j, k}); });
    }
  }

  VertexId add_vertex(int axis, const Node& at) {
    const std::size_t node = grid_.index(at[0], at[1], at[2]);
    const std::size_t next = node + (axis == 0 ? 1 : axis == 1 ? nx_ : nx_ * ny_);
    Vec3 position(grid_.coordinate(0, at[0]), grid_.coordinate(1, at[1]), grid_.coordinate(2, at[2]));
    const double t = zero_between(value(node), value(next));
    position[axis] += t * (grid_.coordinate(axis, at[axis] + 1) - position[axis]);
    const VertexId vertex = add_point(position);
    if (is_in_outer_face((axis + 1) % 3, at) || is_in_outer_face((axis + 2) % 3, at)) mesh_.shared.push_back({name_of(axis, at), vertex});
    return vertex;
  }

  [[nodiscard]] bool is_in_outer_face(int axis, const Node& at) const { return at[axis] == 0 || at[axis] + 1 == grid_.size[axis]; }

  [[nodiscard]] GridEdge name_of(int axis, const Node& at) const {
    GridEdge edge{grid_.first, axis};
    for (int i = 0; i < 3; ++i) edge.node[i] += static_cast<std::int32_t>(at[i]);
    return edge;
  }

  VertexId add_point(const Vec3& position) {
    if (mesh_.points.size() >= kMostVertices) throw InvalidInput("the surface has more vertices than 32-bit indices can number");
    mesh_.points.push_back(position);
    return static_cast<VertexId>(mesh_.points.size() - 1);
  }

  /// Finds, for the edges of the cells in the layer from node layer k to k + 1, where the numbers of their vertices are kept.
  void enter_layer(std::size_t k) {
    for (int edge = 0; edge < cube::kEdges; ++edge) {
      const int low = cube::low_corner(edge);
      const std::size_t layer = (k + (low >> 2)) % 2;
      const int axis = cube::axis_of_edge(edge);
      const std::vector<VertexId>& numbers = edges_of_layers_[axis == 0 ? kAlongX + layer : axis == 1 ? kAlongY + layer : kAlongZ];
      numbers_[edge] = numbers.data() + (low & 1) + (low >> 1 & 1) * nx_;
    }
  }

  void mesh_row(std::size_t j, std::size_t k) {
    const LayerSigns& below = signs_[k % 2];
    const LayerSigns& above = signs_[(k + 1) % 2];
    std::array<std::uint64_t, cube::kCorners> corners{};
    const auto crossed = [&](std::size_t word) {
      corners = {below.nodes(j, word), below.next_nodes(j, word), below.nodes(j + 1, word), below.next_nodes(j + 1, word),
                 above.nodes(j, word), above.next_nodes(j, word), above.nodes(j + 1, word), above.next_nodes(j + 1, word)};
      std::uint64_t any = 0;
      std::uint64_t all = ~any;
      for (const std::uint64_t bits : corners) {
        any |= bits;
        all &= bits;
      }
      return any & ~all;
    };
    for_each_bit(nx_ - 1, crossed, [&](std::size_t i) { mesh_cell(inside_of_cell(corners, i % kBitsPerWord), {i, j, k}); });
  }

  static unsigned inside_of_cell(const std::array<std::uint64_t, cube::kCorners>& corners, std::size_t bit) {
    unsigned inside = 0;
    for (int corner = 0; corner < cube::kCorners; ++corner) inside |= static_cast<unsigned>(corners[corner] >> bit & 1U) << corner;
    return inside;
  }

  void mesh_cell(unsigned inside, const Node& cell) {
    ++report_.surface_cells;
    const PlainCell& plain = plain_cells_[inside];
    if (plain.count != 0) return mesh_plain_cell(plain.loop(), cell[1] * nx_ + cell[0]);
    mesh_other_cell(cell);
  }

  void mesh_plain_cell(std::span<const std::uint8_t> loop, std::size_t at) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      ids_[i] = numbers_[loop[i]][at];
      positions_[i] = mesh_.points[ids_[i]];
    }
    const std::size_t apex = best_fan_apex({positions_.data(), n});
    const auto from_apex = [&](std::size_t i) { return ids_[apex + i < n ? apex + i : apex + i - n]; };
    for (std::size_t i = 1; i + 1 < n; ++i) mesh_.triangles.push_back({ids_[apex], from_apex(i), from_apex(i + 1)});
  }

  void mesh_other_cell(const Node& cell) {
    const cube::CornerValues values = corner_values(grid_.index(cell[0], cell[1], cell[2]));
    const CellLoops loops = trace_cell_loops(values);
    std::optional<Tunnel> tunnel = find_tunnel(values, loops);
    if (tunnel) tunnel->move_waist_to(corner_of(cell, 0), corner_of(cell, 1));
    collect_vertices(loops, cell[1] * nx_ + cell[0]);
    triangulate_cell(positions_, loops, tunnel, patch_);
    append_patch();
    if (loops.ambiguous_faces != 0 || loops.count > 1) ++report_.ambiguous_cells;
    if (tunnel) ++report_.tunnel_cells;
  }

  [[nodiscard]] cube::CornerValues corner_values(std::size_t node) const {
    cube::CornerValues values;
    for (int corner = 0; corner < cube::kCorners; ++corner)
      values[corner] = value(node + (corner & 1) + (corner >> 1 & 1) * nx_ + (corner >> 2) * nx_ * ny_);
    return values;
  }

  /// The lowest (0) or the highest (1) corner of a cell.
  [[nodiscard]] Vec3 corner_of(const Node& cell, std::size_t end) const {
    return {grid_.coordinate(0, cell[0] + end), grid_.coordinate(1, cell[1] + end), grid_.coordinate(2, cell[2] + end)};
  }

  void collect_vertices(const CellLoops& loops, std::size_t at) {
    for (int n = 0; n < loops.begin[loops.count]; ++n) {
      const int edge = loops.edges[n];
      ids_[edge] = numbers_[edge][at];
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
  const std::array<PlainCell, 256>& plain_cells_ = plain_cells();
  std::array<LayerSigns, 2> signs_;
  std::array<std::vector<VertexId>, kEdgeKinds> edges_of_layers_;  // per node: the vertex on its edge
  std::array<const VertexId*, cube::kEdges> numbers_{};            // of the current cells' edges, by the cell's low node in its layer
  std::array<Vec3, cube::kEdges> positions_;
  std::array<VertexId, CellPatch::kMaxPoints> ids_{};
  CellPatch patch_;
  BlockMesh& mesh_;
  TrilinearSurfaceReport report_;
};

}  // namespace

void require_resolution(double spacing, double distance) {
  if (!(distance <= kFarthestInSpacings * spacing))
    throw InvalidInput(fmt::format("a grid of spacing {} cannot be resolved at a distance of {} from the origin", spacing, distance));
}

TrilinearSurfaceReport& TrilinearSurfaceReport::operator+=(const TrilinearSurfaceReport& other) {
  surface_cells += other.surface_cells;
  ambiguous_cells += other.ambiguous_cells;
  tunnel_cells += other.tunnel_cells;
  interior_vertices += other.interior_vertices;
  return *this;
}

TrilinearSurfaceReport mesh_trilinear_block(const ScalarGrid& block, double isovalue, BlockMesh& mesh, const ProgressCallback& progress) {
  if (block.node_count() == 0) {
    mesh = {};
    return {};
  }
  return BlockSweep(block, isovalue, mesh).run(progress);
}

}  // namespace smopt
