#include "smopt/surface/adaptive_surface.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "smopt/surface/block_mesh.h"
#include "smopt/surface/cell_loops.h"
#include "smopt/surface/cell_surroundings.h"
#include "smopt/surface/cell_triangulation.h"
#include "smopt/surface/cell_tunnel.h"
#include "smopt/surface/disc_triangulation.h"
#include "smopt/surface/hanging_loop.h"
#include "smopt/surface/place_map.h"
#include "smopt/surface/trilinear_block.h"

namespace smopt {
namespace {

using Id = CellForest::Id;

/// The leaves that are meshed together.
constexpr std::size_t kLeavesPerBlock = 4096;

void add(AdaptiveSurfaceReport& sum, const AdaptiveSurfaceReport& part) {
  sum.surface_cells.resize(std::max(sum.surface_cells.size(), part.surface_cells.size()));
  for (std::size_t level = 0; level < part.surface_cells.size(); ++level) sum.surface_cells[level] += part.surface_cells[level];
  sum.hanging_cells += part.hanging_cells;
  sum.folded_cells += part.folded_cells;
  sum.ambiguous_cells += part.ambiguous_cells;
  sum.tunnel_cells += part.tunnel_cells;
  sum.interior_vertices += part.interior_vertices;
}

/// A node by its number on the finest grid, and the continuous interpolant there.
struct Node {
  std::array<std::int32_t, 3> number{};
  double value = 0;
};

/// Meshes some leaves, one after another.
class LeafMesher {
 public:
  explicit LeafMesher(const AdaptivePartition& partition) : finder_(partition.forest), lattice_(partition.lattice) {
    halvings_ = lattice_.finest_level + CellLattice::kHalvingsBelowCells;
    unit_ = lattice_.edge(halvings_);
  }

  void add_leaf(Id id) {
    const CellForest::Cell& cell = finder_.forest().cell(id);
    if (!cell.may_be_crossed && cell.place.level == 0) return;  // no corner hangs on a coarser cell, and all have one sign
    around_ = surroundings_of(finder_, id);
    values_ = continuous_values(finder_, id, around_);
    if (!is_crossed(values_)) return;
    place_ = cell.place;
    const int level = place_.level;
    if (report_.surface_cells.size() <= static_cast<std::size_t>(level)) report_.surface_cells.resize(static_cast<std::size_t>(level) + 1);
    ++report_.surface_cells[static_cast<std::size_t>(level)];
    if (around_.split_faces == 0) {
      mesh_simple_cell();
    } else {
      mesh_hanging_cell();
    }
  }

  BlockMesh take_mesh() {
    mesh_.shared.reserve(vertex_on_.size());
    vertex_on_.for_each([&](const auto& key, std::int32_t vertex) {
      mesh_.shared.push_back({{{key[0], key[1], key[2]}, key[3]}, static_cast<VertexId>(vertex)});
    });
    return std::move(mesh_);
  }

  [[nodiscard]] const AdaptiveSurfaceReport& report() const { return report_; }

 private:
  // ---- nodes and vertices ----

  /// The finest nodes in an edge of the cell.
  [[nodiscard]] std::int32_t cell_size() const { return 1 << (halvings_ - place_.level); }

  [[nodiscard]] std::array<std::int32_t, 3> corner_number(int corner) const {
    std::array<std::int32_t, 3> number{};
    for (int axis = 0; axis < 3; ++axis) number[axis] = (place_.at[axis] + (corner >> axis & 1)) * cell_size();
    return number;
  }

  [[nodiscard]] Node corner_node(int corner) const { return {corner_number(corner), values_[corner]}; }

  [[nodiscard]] static Node middle_of(const Node& a, const Node& b) {
    Node middle;
    for (int axis = 0; axis < 3; ++axis) middle.number[axis] = (a.number[axis] + b.number[axis]) / 2;
    middle.value = 0.5 * (a.value + b.value);
    return middle;
  }

  [[nodiscard]] double coordinate(int axis, std::int32_t number) const { return lattice_.origin[axis] + unit_ * number; }

  /// The vertex between two nodes of different sign, the first one low on the axis.
  VertexId vertex_between(const Node& low, const Node& high, int axis) {
    const auto next = static_cast<std::int32_t>(mesh_.points.size());
    const std::int32_t vertex = vertex_on_.find_or_add({low.number[0], low.number[1], low.number[2], axis}, next);
    if (vertex == next) mesh_.points.push_back(zero_on_edge(low, high, axis));
    return static_cast<VertexId>(vertex);
  }

  [[nodiscard]] Vec3 position_of(const std::array<std::int32_t, 3>& number) const {
    return {coordinate(0, number[0]), coordinate(1, number[1]), coordinate(2, number[2])};
  }

  [[nodiscard]] Vec3 zero_on_edge(const Node& low, const Node& high, int axis) const {
    Vec3 position = position_of(low.number);
    position[axis] += zero_between(low.value, high.value) * (coordinate(axis, high.number[axis]) - position[axis]);
    return position;
  }

  VertexId vertex_between_unordered(const Node& a, const Node& b) {
    int axis = 0;
    while (a.number[axis] == b.number[axis]) ++axis;
    return a.number[axis] < b.number[axis] ? vertex_between(a, b, axis) : vertex_between(b, a, axis);
  }

  /// The vertex on an edge of the cube, in the half that changes sign where smaller cells have it in halves.
  VertexId vertex_on_edge(int edge) {
    const Node low = corner_node(cube::low_corner(edge));
    const Node high = corner_node(cube::high_corner(edge));
    const int axis = cube::axis_of_edge(edge);
    if ((around_.split_edges >> edge & 1U) == 0) return vertex_between(low, high, axis);
    const Node middle = middle_of(low, high);
    return is_inside(low.value) != is_inside(middle.value) ? vertex_between(low, middle, axis) : vertex_between(middle, high, axis);
  }

  /// The vertex on the line from the middle of a face's side to the centre of the face.
  VertexId vertex_in_face(int face, int side) {
    const std::array<int, 4> q = cube::corners_of_face(face);
    const Node middle = middle_of(corner_node(q[static_cast<std::size_t>(side)]), corner_node(q[static_cast<std::size_t>((side + 1) % 4)]));
    Node centre = middle_of(corner_node(q[0]), corner_node(q[2]));
    centre.value = hanging::values_on_face(values_, face).centre;
    return vertex_between_unordered(middle, centre);
  }

  VertexId add_interior_point(const Vec3& position) {
    ++report_.interior_vertices;
    mesh_.points.push_back(position);
    return static_cast<VertexId>(mesh_.points.size() - 1);
  }

  // ---- cells all of whose faces are whole ----

  void mesh_simple_cell() {
    const CellLoops loops = trace_cell_loops(values_);
    std::optional<Tunnel> tunnel = find_tunnel(values_, loops);
    if (tunnel) tunnel->move_waist_to(position_of(corner_number(0)), position_of(corner_number(cube::kCorners - 1)));
    std::array<Vec3, cube::kEdges> positions;
    for (int n = 0; n < loops.begin[loops.count]; ++n) {
      const int edge = loops.edges[n];
      ids_[edge] = vertex_on_edge(edge);
      positions[edge] = mesh_.points[ids_[edge]];
    }
    triangulate_cell(positions, loops, tunnel, patch_);
    for (std::size_t i = cube::kEdges; i < patch_.points.size(); ++i) ids_[i] = add_interior_point(patch_.points[i]);
    for (const auto& [a, b, c] : patch_.triangles) mesh_.triangles.push_back({ids_[a], ids_[b], ids_[c]});
    if (loops.ambiguous_faces != 0 || loops.count > 1) ++report_.ambiguous_cells;
    if (tunnel) ++report_.tunnel_cells;
  }

  // ---- cells with faces cut in four ----

  void mesh_hanging_cell() {
    const std::optional<std::vector<std::uint8_t>> loop = trace_hanging_loop(values_, around_.split_faces);
    if (!loop) throw std::logic_error("a cell beside smaller ones holds more than a disc");
    ++report_.hanging_cells;
    std::array<Vec3, hanging::kPoints> positions;
    std::array<unsigned, hanging::kPoints> faces{};
    for (const std::uint8_t point : *loop) {
      ids_[point] = point < cube::kEdges ? vertex_on_edge(point) : vertex_in_face((point - cube::kEdges) / 4, (point - cube::kEdges) % 4);
      positions[point] = mesh_.points[ids_[point]];
      faces[point] = hanging::faces_of_point(point);
    }
    if (const auto triangles = clip_ears(*loop, positions, faces)) {
      for (const auto& [a, b, c] : *triangles) mesh_.triangles.push_back({ids_[a], ids_[b], ids_[c]});
    } else {
      fill_from_inside(*loop, positions);
    }
  }

  /// The projection from a point inside the cube onto its boundary is injective.
  void fill_from_inside(const std::vector<std::uint8_t>& loop, const std::array<Vec3, hanging::kPoints>& positions) {
    ++report_.folded_cells;
    Vec3 sum = Vec3::Zero();
    for (const std::uint8_t point : loop) sum += positions[point];
    const VertexId apex = add_interior_point(sum / static_cast<double>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i) mesh_.triangles.push_back({apex, ids_[loop[i]], ids_[loop[(i + 1) % loop.size()]]});
  }

  CellFinder finder_;
  const CellLattice& lattice_;
  int halvings_ = 0;
  double unit_ = 1;
  // of the cell at hand:
  CellPlace place_;
  CellSurroundings around_;
  cube::CornerValues values_{};
  std::array<VertexId, std::max(hanging::kPoints, CellPatch::kMaxPoints)> ids_{};
  CellPatch patch_;
  // of all cells:
  PlaceMap<4> vertex_on_;  ///< by the low node of an edge and its axis
  BlockMesh mesh_;
  AdaptiveSurfaceReport report_;
};

/// The leaves below a cell, in the order of the cube's corners.
void append_leaves(const CellForest& forest, Id id, std::vector<Id>& leaves) {
  if (forest.is_leaf(id)) {
    leaves.push_back(id);
    return;
  }
  for (int child = 0; child < cube::kCorners; ++child) append_leaves(forest, forest.first_child(id) + child, leaves);
}

/// All leaves: tree by tree, in the order of the roots.
std::vector<Id> leaves_in_order(const CellForest& forest) {
  std::vector<Id> leaves;
  for (Id id = 0; id < static_cast<Id>(forest.cells().size()); ++id) {
    if (forest.cell(id).place.level == 0) append_leaves(forest, id, leaves);
  }
  return leaves;
}

}  // namespace

TriangleMesh adaptive_surface(const AdaptivePartition& partition, AdaptiveSurfaceReport* report, const ProgressCallback& progress) {
  const std::vector<Id> leaves = leaves_in_order(partition.forest);
  std::vector<BlockMesh> blocks((leaves.size() + kLeavesPerBlock - 1) / kLeavesPerBlock);
  std::vector<AdaptiveSurfaceReport> reports(blocks.size());
  report_progress(progress, "surface", 0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
    LeafMesher mesher(partition);
    const std::size_t end = std::min(leaves.size(), (block + 1) * kLeavesPerBlock);
    for (std::size_t i = block * kLeavesPerBlock; i < end; ++i) mesher.add_leaf(leaves[i]);
    reports[block] = mesher.report();
    blocks[block] = mesher.take_mesh();
  });
  if (report) {
    AdaptiveSurfaceReport sum;
    for (const AdaptiveSurfaceReport& part : reports) add(sum, part);
    if (!sum.surface_cells.empty()) sum.finest_edge = partition.lattice.edge(static_cast<int>(sum.surface_cells.size()) - 1);
    *report = sum;
  }
  return joined(std::move(blocks));
}

}  // namespace smopt
