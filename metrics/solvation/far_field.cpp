#include "metrics/solvation/far_field.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/solvation/batches.h"
#include "smopt/error.h"

namespace smopt::metrics {
namespace {

/// A cluster much smaller than all the points together has no grid: dipoles on it are differences of charges of the order 1/extent, which would cost
/// as many digits. At 1e-6 nine or ten are left.
constexpr double kLeastGridRadiusRel = 1e-6;

/// A cluster has a grid if its points are this many times the grid's at least. A pair of grid points costs 1.2 ns, a pair of points with dipoles and
/// gradients 2.3 ns (AVX-512), so that both ways take the same time at 0.73.
constexpr double kLeastPointsRel = 0.73;

/// Relative error by degree at the default theta: see options_for. The largest that was measured, for smooth and for random sources on bumpy spheres
/// of 10 000 to 160 000 points, both kernels, potential and gradient, kappa 0, 0.125714 and 1, times 1.5 at least.
struct ErrorOfDegree {
  double error;
  int degree;
};
constexpr ErrorOfDegree kErrors[] = {{1.5e-2, 2}, {2.5e-3, 3}, {2.5e-4, 4}, {3e-5, 5}, {4e-6, 6},
                                     {6e-7, 7},   {1e-7, 8},   {2e-8, 9},   {5e-9, 10}};

const std::vector<Vec3>& require_finite(const std::vector<Vec3>& points) {
  if (points.size() >= std::numeric_limits<std::uint32_t>::max()) throw InvalidInput("far field: more than 2^32 points");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite()) throw InvalidInput(fmt::format("far field: point {} has a coordinate that is not finite", i));
  return points;
}

const FarFieldOptions& require_valid(const FarFieldOptions& options) {
  if (!(options.kappa >= 0 && std::isfinite(options.kappa))) throw InvalidOption("far field: kappa must be at least 0 and finite");
  if (!(options.theta > 0 && options.theta < 1)) throw InvalidOption("far field: theta must be in (0, 1)");
  if (options.degree < 1 || options.degree > kHighestDegree)
    throw InvalidOption(fmt::format("far field: degree must be 1 to {}", kHighestDegree));
  if (options.leaf_size < 1) throw InvalidOption("far field: leaf_size must be at least 1");
  return options;
}

std::size_t grid_size(int degree) {
  const auto along = static_cast<std::size_t>(degree) + 1;
  return along * along * along;
}

}  // namespace

FarField::FarField(const std::vector<Vec3>& points, const FarFieldOptions& options, const std::vector<double>& reaches)
    : options_(require_valid(options)),
      tree_(require_finite(points), static_cast<std::size_t>(options.leaf_size)),
      lists_(interaction_lists(tree_, options.theta, largest_reaches(tree_, reaches))),
      basis_(options.degree),
      points_(in_tree_order(tree_, points)) {
  make_grids();
  if (!tree_.is_empty()) find_blocks(0, 0);
}

void FarField::make_grids() {
  grid_of_.assign(tree_.clusters().size(), kNoGrid);
  for (ClusterId c = 0; c < tree_.clusters().size(); ++c) {
    if (static_cast<double>(tree_[c].size()) < kLeastPointsRel * static_cast<double>(grid_size(options_.degree)) ||
        !(tree_[c].radius > kLeastGridRadiusRel * tree_[0].radius))
      continue;
    grid_of_[c] = static_cast<std::uint32_t>(grid_clusters_.size());
    grid_clusters_.push_back(c);
  }
  for (Eigen::MatrixXd& along : nodes_) along.resize(static_cast<Eigen::Index>(grid_size(options_.degree)), grid_clusters_.size());
  for (std::size_t g = 0; g < grid_clusters_.size(); ++g) {
    const auto coordinates = grid_points(basis_, box_of(grid_clusters_[g]));
    for (std::size_t axis = 0; axis < 3; ++axis) nodes_[axis].col(static_cast<Eigen::Index>(g)) = coordinates[axis];
  }
}

void FarField::find_blocks(ClusterId cluster, ClusterId parent) {
  if (!has_grid(cluster) || tree_[cluster].is_leaf()) {
    blocks_.push_back({cluster, has_grid(cluster) ? cluster : parent});
    return;
  }
  find_blocks(cluster + 1, cluster);
  find_blocks(tree_[cluster].second_half, cluster);
}

Eigen::Ref<const Eigen::MatrixX3d> FarField::points_of(ClusterId cluster) const {
  return points_.middleRows(tree_[cluster].begin, static_cast<Eigen::Index>(tree_[cluster].size()));
}

std::uint64_t FarField::near_pair_count() const {
  std::uint64_t pairs = 0;
  for (const ClusterId leaf : tree_.leaves())
    for (const ClusterId source : near_sources(leaf)) pairs += tree_[leaf].size() * tree_[source].size();
  return pairs;
}

class FarField::Sum {
 public:
  Sum(const FarField& far, const std::vector<PointSources>& sources) : far_(far), sources_(far.tree_, sources) {
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
      charges_[kernel] = potentials_[kernel] = Eigen::MatrixXd::Zero(far.nodes_[0].rows(), far.nodes_[0].cols());
    }
  }

  /// Charges of the grids of this cluster and of those within, from the points up.
  void gather_charges(ClusterId cluster) {
    if (!far_.has_grid(cluster)) return;
    if (far_.tree_[cluster].is_leaf()) {
      add_charges_of_points(cluster, cluster);
      return;
    }
    const ClusterId halves[2] = {cluster + 1, far_.tree_[cluster].second_half};
    tbb::parallel_invoke([&] { gather_charges(halves[0]); }, [&] { gather_charges(halves[1]); });
    for (const ClusterId half : halves) {
      if (far_.has_grid(half)) {
        add_charges_of_child(half, cluster);
      } else {
        add_charges_of_points(half, cluster);
      }
    }
  }

  /// Potentials at the points of one grid, from all clusters that are far from its own.
  void exchange(std::size_t grid) {
    const auto g = static_cast<Eigen::Index>(grid);
    auto lanes = lanes_for(static_cast<std::size_t>(far_.nodes_[0].rows()),
                           [&](Eigen::Index i, Eigen::Index axis) { return far_.nodes_[static_cast<std::size_t>(axis)](i, g); });
    add_far_sources(far_.grid_clusters_[grid], lanes, TargetKind::potentials);
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel)
      for (Eigen::Index i = 0; i < far_.nodes_[0].rows(); ++i) {
        const auto place = static_cast<std::size_t>(i);
        potentials_[kernel](i, g) = lanes[place / kTargetLanes].potential[kernel][place % kTargetLanes];
      }
  }

  /// Adds what acts on a cluster to its halves, from this cluster down.
  void spread_potentials(ClusterId cluster) {
    if (!far_.has_grid(cluster) || far_.tree_[cluster].is_leaf()) return;
    const auto enter = [&](ClusterId half) {
      if (!far_.has_grid(half)) return;
      const GridTransfer transfer(far_.basis_, far_.box_of(half), far_.box_of(cluster));
      for (std::size_t kernel = 0; kernel < kKernels; ++kernel)
        transfer.add_values_to_child(column(potentials_[kernel], cluster), column(potentials_[kernel], half));
      spread_potentials(half);
    };
    tbb::parallel_invoke([&] { enter(cluster + 1); }, [&] { enter(far_.tree_[cluster].second_half); });
  }

  /// Adds all that is far from the points of a block to their fields.
  void evaluate(const Block& block, std::vector<PointFields>& fields) const {
    if (far_.has_grid(block.parent)) add_from_grid(block, fields);
    for (ClusterId c = block.cluster; c < far_.tree_[block.cluster].past; ++c)
      if (!far_.has_grid(c) && !far_.lists_.far.of(c).empty()) add_at_points(c, fields);
  }

 private:
  [[nodiscard]] Eigen::Index column_of(ClusterId cluster) const { return far_.grid_of_[cluster]; }
  [[nodiscard]] Eigen::MatrixXd::ColXpr column(Eigen::MatrixXd& of_grids, ClusterId cluster) const {
    return of_grids.col(column_of(cluster));
  }

  void add_charges_of_child(ClusterId child, ClusterId parent) {
    const GridTransfer transfer(far_.basis_, far_.box_of(child), far_.box_of(parent));
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel)
      transfer.add_charges_to_parent(column(charges_[kernel], child), column(charges_[kernel], parent));
  }

  void add_charges_of_points(ClusterId cluster, ClusterId parent) {
    const PointBasis basis(far_.points_of(cluster), far_.box_of(parent), far_.basis_.size());
    const Cluster& c = far_.tree_[cluster];
    const auto count = static_cast<Eigen::Index>(c.size());
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
      Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(far_.nodes_[0].rows());
      const PointMoments& all = sources_[kernel];
      basis.add_to_coefficients({all.number.segment(c.begin, count), all.vector.middleRows(c.begin, count)}, coefficients);
      add_charges(far_.basis_, coefficients, column(charges_[kernel], parent));
    }
  }

  [[nodiscard]] SourceView grid_as_sources(ClusterId cluster) const {
    SourceView view;
    view.count = static_cast<std::size_t>(far_.nodes_[0].rows());
    for (std::size_t axis = 0; axis < 3; ++axis) view.position[axis] = far_.nodes_[axis].col(column_of(cluster)).data();
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel) view.charge[kernel] = charges_[kernel].col(column_of(cluster)).data();
    return view;
  }

  void add_far_sources(ClusterId target, std::span<TargetLanes> lanes, TargetKind target_kind) const {
    for (const ClusterId source : far_.lists_.far.of(target)) {
      if (far_.has_grid(source)) {
        add_pair_sums(grid_as_sources(source), far_.options_.kappa, lanes, SourceKind::charges, target_kind);
      } else {
        add_pair_sums(sources_.view(far_.tree_[source], far_.points_), far_.options_.kappa, lanes, SourceKind::charges_and_dipoles,
                      target_kind);
      }
    }
  }

  void add_from_grid(const Block& block, std::vector<PointFields>& fields) const {
    const PointBasis basis(far_.points_of(block.cluster), far_.box_of(block.parent), far_.basis_.size());
    const auto points = far_.tree_.points_of(block.cluster);
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
      const PointMoments values = basis.evaluate(coefficients_of(far_.basis_, potentials_[kernel].col(column_of(block.parent))));
      for (std::size_t i = 0; i < points.size(); ++i) {
        PotentialAndGradient& field = fields[points[i]][kernel];
        field.potential += values.number[static_cast<Eigen::Index>(i)];
        field.gradient += values.vector.row(static_cast<Eigen::Index>(i)).transpose();
      }
    }
  }

  void add_at_points(ClusterId cluster, std::vector<PointFields>& fields) const {
    auto lanes = lanes_of(far_.tree_[cluster], far_.points_);
    add_far_sources(cluster, lanes, TargetKind::potentials_and_gradients);
    add_to_fields(lanes, far_.tree_.points_of(cluster), fields);
  }

  const FarField& far_;
  TreeSources sources_;
  std::array<Eigen::MatrixXd, kKernels> charges_;  // a column a grid
  std::array<Eigen::MatrixXd, kKernels> potentials_;
};

void FarField::apply(const std::vector<PointSources>& sources, std::vector<PointFields>& fields, const ProgressCallback& progress) const {
  const std::size_t count = tree_.order().size();
  if (sources.size() != count || fields.size() != count)
    throw InvalidInput(fmt::format("far field: {} sources and {} fields for {} points", sources.size(), fields.size(), count));
  if (count == 0) return;
  Sum sum(*this, sources);
  sum.gather_charges(0);
  in_batches(grid_clusters_.size(), progress, "far field: clusters", [&](std::size_t grid) { sum.exchange(grid); });
  sum.spread_potentials(0);
  in_batches(blocks_.size(), progress, "far field: points", [&](std::size_t block) { sum.evaluate(blocks_[block], fields); });
}

FarFieldOptions options_for(double tolerance, double kappa) {
  const auto* const fit =
      std::find_if(std::begin(kErrors), std::end(kErrors), [&](const ErrorOfDegree& e) { return e.error <= tolerance; });
  if (fit == std::end(kErrors) || !(tolerance < 1))
    throw InvalidOption(fmt::format("far field: tolerance must be in [{}, 1)", std::end(kErrors)[-1].error));
  FarFieldOptions options;
  options.kappa = kappa;
  options.degree = fit->degree;
  return options;
}

double far_field_bytes(std::size_t points, const FarFieldOptions& options) {
  // Measured on bumpy spheres of 10 000 to 160 000 points, leaves of 16 to 64, theta 0.5 to 0.8, degrees 3 to 8; rounded up.
  constexpr double kClustersByLeaves = 3;      // clusters · leaf_size / points
  constexpr double kGridPointsByPoints = 2.2;  // of all grids
  constexpr double kListsByTheta = 9;          // list entries a cluster · theta²
  // A grid point has three coordinates, two charges, two potentials.
  constexpr double kGridPointBytes = 7 * sizeof(double);
  // Three coordinates, two charges and two dipoles in the tree's order, and the order.
  constexpr double kPointBytes = 11 * sizeof(double) + sizeof(std::uint32_t);
  // A vector that grows can be twice as large as what it holds. Two lists' begins and the grid's number belong to a cluster.
  constexpr double kClusterBytes = 2 * sizeof(Cluster) + 2 * sizeof(std::size_t) + sizeof(std::uint32_t);
  // An entry, and half a pair twice as large as what it holds.
  constexpr double kEntryBytes = sizeof(ClusterId) + 2 * sizeof(ClusterId);
  const auto n = static_cast<double>(points);
  const double clusters = 1 + kClustersByLeaves * n / options.leaf_size;
  const double entries = std::min(clusters * kListsByTheta / (options.theta * options.theta), clusters * clusters);
  return n * kPointBytes + kGridPointsByPoints * n * kGridPointBytes + clusters * kClusterBytes + entries * kEntryBytes;
}

}  // namespace smopt::metrics
