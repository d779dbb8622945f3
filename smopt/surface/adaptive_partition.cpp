#include "smopt/surface/adaptive_partition.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "smopt/parallel.h"
#include "smopt/surface/cell_surroundings.h"
#include "smopt/surface/face_links.h"
#include "smopt/surface/hanging_loop.h"
#include "smopt/surface/positive_option.h"

namespace smopt {
namespace {

using Cell = CellForest::Cell;
using Id = CellForest::Id;

/// Edge of the cells of level 0 times √d: with samples at half of it, kernels of width 0.7/√d are seen wherever they are.
constexpr double kRootEdgeTimesRootDecay = 1.2;

/// Cells of level 0 are sampled in blocks of so many on a side: an atom's kernel covers about as much.
constexpr std::int32_t kBlockEdge = 8;

/// Node numbers stay below this, so that sums of a few of them fit 32 bits.
constexpr double kMostNodes = 1 << 29;

/// Finest cells whose edge is less than this part of the farthest coordinate cannot hold apart points of a surface in them.
constexpr double kLeastEdgeRelative = 1e-9;

CellLattice lattice_for(const GaussianField& field, double error) {
  require_positive(error, "the error");
  CellLattice lattice;
  lattice.root_edge = kRootEdgeTimesRootDecay / std::sqrt(field.decay());
  lattice.finest_level = std::max(0, static_cast<int>(std::ceil(std::log2(lattice.root_edge * std::sqrt(3.0) / error))));
  lattice.origin = field.low() - Vec3::Constant(lattice.root_edge);

  const double finest = lattice.edge(lattice.finest_level);
  const double extent = (field.high() - lattice.origin).maxCoeff() + 2 * lattice.root_edge * kBlockEdge;
  const double farthest = std::max(lattice.origin.cwiseAbs().maxCoeff(), field.high().cwiseAbs().maxCoeff());
  if (std::ldexp(extent / finest, CellLattice::kHalvingsBelowCells) > kMostNodes || finest < kLeastEdgeRelative * farthest)
    throw InvalidInput(
        fmt::format("an error of {} Å asks for cells of {:.3g} Å, too small for a molecule of {:.6g} Å, {:.6g} Å from the origin", error,
                    finest, extent, farthest));
  return lattice;
}

/// What a look at a leaf asks for. The reasons are in order: only the first one that applies is given.
struct Wishes {
  std::vector<std::array<std::int32_t, 3>> roots;  ///< cells of level 0 that are not there yet
  std::vector<Id> divide_for_error;
  std::vector<Id> divide_for_balance;
  std::vector<Id> divide_for_hanging;
  std::vector<Id> divide_for_topology;
  std::vector<Id> undecided;  ///< leaves about which more can be said when this is done

  [[nodiscard]] bool empty() const {
    return undecided.empty() && roots.empty() && divide_for_error.empty() && divide_for_balance.empty() && divide_for_hanging.empty() &&
           divide_for_topology.empty();
  }
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

class Partitioner {
 public:
  Partitioner(const GaussianField& field, double isovalue, double error)
      : field_(field), error_(error), lattice_(lattice_for(field, error)), sampler_(field, isovalue, lattice_) {}

  AdaptivePartition run(AdaptivePartitionReport& report, const ProgressCallback& progress) {
    plant_roots(progress);
    settle(all_leaves(), report, progress);
    while (settle(hanging_leaves(), report, progress)) {
    }
    return {lattice_, std::move(forest_)};
  }

 private:
  // ---- the cells of level 0 ----

  /// The first cells of the blocks that an atom reaches, in order.
  [[nodiscard]] std::vector<std::array<std::int32_t, 3>> reached_blocks() const {
    return field_.reached_cubes(lattice_.origin, lattice_.root_edge * kBlockEdge);
  }

  void plant_roots(const ProgressCallback& progress) {
    const std::vector<std::array<std::int32_t, 3>> blocks = reached_blocks();
    std::vector<std::vector<Cell>> kept(blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      const auto& [x, y, z] = blocks[i];
      kept[i] = near_surface(sampler_.block_of_roots({x * kBlockEdge, y * kBlockEdge, z * kBlockEdge}, kBlockEdge));
    });
    report_progress(progress, "partition", 0.25);
    for (const std::vector<Cell>& cells : kept) {
      for (const Cell& cell : cells) forest_.add_root(cell);
    }
  }

  /// Of the cells of a block, those that may be crossed and those beside them: these may have smaller neighbours.
  static std::vector<Cell> near_surface(const std::vector<Cell>& block) {
    const auto at = [](int i, int j, int k) { return static_cast<std::size_t>((k * kBlockEdge + j) * kBlockEdge + i); };
    std::vector<bool> is_near(block.size(), false);
    for (int k = 0; k < kBlockEdge; ++k) {
      for (int j = 0; j < kBlockEdge; ++j) {
        for (int i = 0; i < kBlockEdge; ++i) {
          if (!block[at(i, j, k)].may_be_crossed) continue;
          for (int z = std::max(0, k - 1); z <= std::min(kBlockEdge - 1, k + 1); ++z) {
            for (int y = std::max(0, j - 1); y <= std::min(kBlockEdge - 1, j + 1); ++y) {
              for (int x = std::max(0, i - 1); x <= std::min(kBlockEdge - 1, i + 1); ++x) is_near[at(x, y, z)] = true;
            }
          }
        }
      }
    }
    std::vector<Cell> near;
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (is_near[i]) near.push_back(block[i]);
    }
    return near;
  }

  // ---- a look at leaves ----

  template <class Predicate>
  [[nodiscard]] std::vector<Id> leaves_where(const Predicate& is_wanted) const {
    std::vector<Id> leaves;
    for (Id id = 0; id < static_cast<Id>(forest_.cells().size()); ++id) {
      if (forest_.is_leaf(id) && is_wanted(id)) leaves.push_back(id);
    }
    return leaves;
  }

  [[nodiscard]] std::vector<Id> all_leaves() const {
    return leaves_where([](Id) { return true; });
  }

  /// Those whose values depend on other cells.
  [[nodiscard]] std::vector<Id> hanging_leaves() const {
    std::vector<char> has_coarser(forest_.cells().size(), 0);
    for_ranges_in_parallel(has_coarser.size(), [&](std::size_t begin, std::size_t end) {
      CellFinder finder(forest_);
      for (auto id = static_cast<Id>(begin); id < static_cast<Id>(end); ++id)
        has_coarser[id] = forest_.is_leaf(id) && forest_.cell(id).place.level > 0 && surroundings_of(finder, id).has_coarser ? 1 : 0;
    });
    return leaves_where([&](Id id) { return has_coarser[id] != 0; });
  }

  /// Looks at leaves, does what they ask for, and looks at the leaves about what was done, until they ask for nothing.
  /// \return whether anything was done. The values of hanging nodes farther off may have changed then.
  bool settle(std::vector<Id> leaves, AdaptivePartitionReport& report, const ProgressCallback& progress) {
    bool has_changed = false;
    while (!leaves.empty()) {
      report_progress(progress, "partition", 0.5);
      const auto first_new = static_cast<Id>(forest_.cells().size());
      const Wishes wishes = examine(leaves);
      grant(wishes, report);
      leaves = wishes.empty() ? std::vector<Id>{} : leaves_about(first_new, wishes.undecided);
      has_changed = has_changed || !leaves.empty();
    }
    return has_changed;
  }

  /// The leaves among the cells from `first_new` on, those that touch them, and those that were left undecided; ascending.
  [[nodiscard]] std::vector<Id> leaves_about(Id first_new, const std::vector<Id>& undecided) const {
    const auto end = static_cast<Id>(forest_.cells().size());
    std::vector<bool> is_about(end, false);
    CellFinder finder(forest_);
    for (Id id = first_new; id < end; ++id) {
      is_about[id] = true;
      const CellPlace& place = forest_.cell(id).place;
      if (place.level > 0 && !place.is_first_child()) continue;  // one look for all eight
      const CellPlace around = place.level > 0 ? place.parent() : place;
      for (int face = 0; face < cube::kFaces; ++face) mark(place_across_face(around, face), finder, is_about);
      for (int edge = 0; edge < cube::kEdges; ++edge) mark(place_across_edge(around, edge), finder, is_about);
    }
    for (const Id id : undecided) is_about[id] = true;
    return leaves_where([&](Id id) { return is_about[id]; });
  }

  /// Marks the cell at a place, or its children where it has some: they may be leaves.
  void mark(const CellPlace& place, CellFinder& finder, std::vector<bool>& is_about) const {
    const Id id = finder.find(place).id;
    if (id == CellForest::kNone) return;
    if (forest_.is_leaf(id))
      is_about[id] = true;
    else
      std::fill_n(is_about.begin() + forest_.first_child(id), cube::kCorners, true);
  }

  [[nodiscard]] Wishes examine(const std::vector<Id>& leaves) const {
    constexpr std::size_t kLeavesPerTask = 1024;
    std::vector<Wishes> parts((leaves.size() + kLeavesPerTask - 1) / kLeavesPerTask);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
      const std::size_t end = std::min(leaves.size(), (part + 1) * kLeavesPerTask);
      CellFinder finder(forest_);
      for (std::size_t i = part * kLeavesPerTask; i < end; ++i) examine(leaves[i], finder, parts[part]);
    });
    Wishes all;
    for (const Wishes& part : parts) {
      append(all.roots, part.roots);
      append(all.divide_for_error, part.divide_for_error);
      append(all.divide_for_balance, part.divide_for_balance);
      append(all.divide_for_hanging, part.divide_for_hanging);
      append(all.divide_for_topology, part.divide_for_topology);
      append(all.undecided, part.undecided);
    }
    return all;
  }

  void examine(Id id, CellFinder& finder, Wishes& wishes) const {
    const Cell& cell = forest_.cell(id);
    if (!cell.may_be_crossed && cell.place.level == 0) return;
    if (!is_fine_enough(cell)) {
      wishes.divide_for_error.push_back(id);
      return;
    }
    const CellSurroundings around = surroundings_of(finder, id);
    if (cell.place.level > 0 && !is_balanced(cell.place, around, wishes)) {
      wishes.undecided.push_back(id);
      return;
    }
    const cube::CornerValues values = continuous_values(finder, id, around);
    if (around.has_coarser && cell.may_be_crossed && hanging_error_is_too_large(cell, values)) {
      for_coarser_leaves(cell.place, around, 1, [&](Id coarser) { wishes.divide_for_hanging.push_back(coarser); });
      wishes.undecided.push_back(id);
      return;
    }
    if (around.split_faces != 0 && is_crossed(values) && !trace_hanging_loop(values, around.split_faces))
      wishes.divide_for_topology.push_back(id);
  }

  /// Whether the surface in the cell is near enough to φ = c.
  [[nodiscard]] bool is_fine_enough(const Cell& cell) const {
    return !cell.may_be_crossed || cell.place.level == lattice_.finest_level ||
           (is_near_by_slope(cell, 0) && is_single_valued_with_field(cell, cell.values));
  }

  /// Whether there is an axis along which both φ, where φ = c may pass, and the interpolant are monotone: then both surfaces are graphs over one
  /// plane, and none has a handle, a fold or a speck that the other has not.
  static bool is_single_valued_with_field(const Cell& cell, const cube::CornerValues& values) {
    return (cube::monotone_axes(values) & cell.monotone_axes) != 0;
  }

  [[nodiscard]] bool is_near_by_slope(const Cell& cell, double hanging_error) const {
    return cell.slope > 0 && cell.error + hanging_error <= error_ * cell.slope;
  }

  /// The values of a cell that is near enough by its slope may be off as long as it stays so; those of one that is near enough by its size
  /// as long as they keep their signs.
  [[nodiscard]] bool hanging_error_is_too_large(const Cell& cell, const cube::CornerValues& values) const {
    double largest = 0;
    bool keep_signs = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      largest = std::max(largest, std::abs(values[i] - cell.values[i]));
      keep_signs = keep_signs && is_inside(values[i]) == is_inside(cell.values[i]);
    }
    if (is_near_by_slope(cell, largest) && is_single_valued_with_field(cell, values)) return false;
    return cell.place.level < lattice_.finest_level || !keep_signs;
  }

  /// Asks for the roots that are missing around a cell, and to divide leaves that are larger by more than one level.
  bool is_balanced(const CellPlace& place, const CellSurroundings& around, Wishes& wishes) const {
    bool is_balanced = true;
    const auto look = [&](const CellFinder::Found& found, const CellPlace& there) {
      if (found.id == CellForest::kNone) {
        wishes.roots.push_back({there.at[0] >> there.level, there.at[1] >> there.level, there.at[2] >> there.level});
        is_balanced = false;
      }
    };
    for (int face = 0; face < cube::kFaces; ++face) look(around.across_face[face], place_across_face(place, face));
    for (int edge = 0; edge < cube::kEdges; ++edge) look(around.across_edge[edge], place_across_edge(place, edge));
    for_coarser_leaves(place, around, 2, [&](Id coarser) {
      wishes.divide_for_balance.push_back(coarser);
      is_balanced = false;
    });
    return is_balanced;
  }

  /// Visits the neighbours that are larger by `levels` or more.
  template <class Visit>
  void for_coarser_leaves(const CellPlace& place, const CellSurroundings& around, int levels, const Visit& visit) const {
    const auto look = [&](const CellFinder::Found& found) {
      if (found.id != CellForest::kNone && found.level <= place.level - levels) visit(found.id);
    };
    for (const CellFinder::Found& found : around.across_face) look(found);
    for (const CellFinder::Found& found : around.across_edge) look(found);
  }

  // ---- what the look asked for ----

  void grant(const Wishes& wishes, AdaptivePartitionReport& report) {
    add_roots(wishes.roots);
    report.for_error += divide(wishes.divide_for_error);
    report.for_balance += divide(wishes.divide_for_balance);
    report.for_hanging += divide(wishes.divide_for_hanging);
    report.for_topology += divide(wishes.divide_for_topology);
  }

  void add_roots(std::vector<std::array<std::int32_t, 3>> places) {
    sort_unique(places);
    std::vector<Cell> cells(places.size());
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) { cells[i] = sampler_.block_of_roots(places[i], 1).front(); });
    for (const Cell& cell : cells) forest_.add_root(cell);
  }

  std::size_t divide(std::vector<Id> cells) {
    sort_unique(cells);
    std::erase_if(cells, [&](Id id) { return !forest_.is_leaf(id); });
    std::vector<std::array<Cell, cube::kCorners>> children(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) { children[i] = sampler_.children(forest_.cell(cells[i]).place); });
    for (std::size_t i = 0; i < cells.size(); ++i) forest_.add_children(cells[i], children[i]);
    return cells.size();
  }

  const GaussianField& field_;
  double error_;
  CellLattice lattice_;
  CellSampler sampler_;
  CellForest forest_;
};

}  // namespace

AdaptivePartition partition_space(const GaussianField& field, double isovalue, double error, AdaptivePartitionReport* report,
                                  const ProgressCallback& progress) {
  AdaptivePartitionReport met;
  AdaptivePartition partition = Partitioner(field, isovalue, error).run(met, progress);
  if (report) *report = met;
  return partition;
}

}  // namespace smopt
