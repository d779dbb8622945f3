#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "metrics/solvation/chebyshev_grid.h"
#include "metrics/solvation/cluster_tree.h"
#include "metrics/solvation/interaction_lists.h"
#include "metrics/solvation/point_sources.h"
#include "smopt/geometry/vec3.h"
#include "smopt/progress.h"

namespace smopt::metrics {

struct FarFieldOptions {
  double kappa = 0.125714;  ///< inverse screening length, 1/ångström; at least 0; AFMPB's default, 150 mM at 300 K
  double theta = 0.7;       ///< clusters interact as wholes when their radii sum up to less than this part of their distance; (0, 1)
  int degree = 6;           ///< of the polynomials along each axis; 1 to kHighestDegree
  int leaf_size = 32;       ///< most points in a leaf; what is near grows with it; at least 1
};

/// Higher degrees gain nothing in double precision.
inline constexpr int kHighestDegree = 16;

/// The least degree whose error is below the tolerance at the default theta: the error of the far part, relative to the sum over all pairs of
/// different points, in the 2-norm over the points, for both kernels, potential and gradient.
///
///   degree                                               2       3       4       5       6       7       8       9       10
///   for tolerances from                                  1.5e-2  2.5e-3  2.5e-4  3e-5    4e-6    6e-7    1e-7    2e-8    5e-9
///   largest error measured, smooth and random sources    8e-3    1.6e-3  1.4e-4  1.9e-5  2.0e-6  3.3e-7  5e-8    1.1e-8  2.8e-9
///   smooth sources, gradient, relative to the far part   8e-2    1e-2    1.0e-3  1.6e-4  2e-5    8e-6    7e-7    6e-8    1.1e-8
///
/// (Bumpy spheres of 10 000 to 160 000 points, kappa 0, 0.125714 and 1; the last line without kappa 1, where the screened far part is next to
/// nothing.)
/// Where near parts cancel, as the kernels' differences in an integral equation do, the last line is what counts.
/// Throws InvalidOption for a tolerance below 5e-9, or not below 1.
FarFieldOptions options_for(double tolerance, double kappa);

/// Sums over the pairs of points that are far from each other, for both kernels G(r) = 1/(4πr) and exp(-kappa·r)/(4πr):
///
///   potential(x_i) = Σ_j q_j G(|x_i - y_j|) + d_j·∇_y G(|x_i - y_j|), and its gradient in x_i.
///
/// The barycentric-Lagrange dual-tree traversal (Wilson, Vaughn & Krasny 2021, Comput. Phys. Commun. 265:108017; Wilson, Geng & Krasny 2022,
/// J. Phys. Chem. B 126:7104): a cluster of points is replaced by charges at a tensor grid of Chebyshev points, between well-separated clusters
/// only grids interact, and a polynomial brings potentials and gradients from the grid to the points. A cluster that has fewer points than its grid
/// would have takes part with its points, by the formulas themselves. Pairs that are not far are the caller's: `near_sources` (see NearField).
///
/// Cost: O(n·log n) to build, O(n·(degree + 1)³) a call of apply for points on a surface. Leaves of 32 leave some 300 near pairs a point. Measured
/// on a bumpy sphere, theta 0.7, kappa 0.125714, processor seconds (AVX-512; the threads share them evenly):
///
///   points                               16 384   65 536   262 144
///   build                                0.01     0.02     0.07
///   apply, tolerance 1e-4 (degree 5)     0.25     1.0      3.9
///   apply, tolerance 1e-6 (degree 7)     0.51     2.4      8.7
///   memory, MB                           5        16       57
class FarField {
 public:
  /// \param points   finite coordinates, ångström; throws InvalidInput if one is not, or if there are 2³² or more.
  /// \param reaches  ångström; a point and another that is not farther than its reach are near. One for each point, or none: all 0.
  /// Throws InvalidOption for an option out of its range.
  FarField(const std::vector<Vec3>& points, const FarFieldOptions& options, const std::vector<double>& reaches = {});

  /// Adds the far part at each point to `fields`. Both vectors are in the order of the points; throws InvalidInput if their sizes are not the
  /// number of points. Throws Cancelled when `progress` says so; `fields` is then part old, part new.
  /// The same bytes for any number of threads; all cores. Several threads may call it at once.
  void apply(const std::vector<PointSources>& sources, std::vector<PointFields>& fields, const ProgressCallback& progress = {}) const;

  /// Gives leaves and their points.
  [[nodiscard]] const ClusterTree& tree() const { return tree_; }
  /// The points in the tree's order, a row each.
  [[nodiscard]] const Eigen::MatrixX3d& points() const { return points_; }
  /// The leaves whose points are near those of `leaf`, ascending, itself among them. Symmetric.
  [[nodiscard]] std::span<const ClusterId> near_sources(ClusterId leaf) const { return lists_.near.of(leaf); }
  /// Ordered pairs of points that are left to the caller, a point with itself too.
  [[nodiscard]] std::uint64_t near_pair_count() const;

 private:
  class Sum;  // one call of apply

  static constexpr std::uint32_t kNoGrid = 0xffffffff;

  /// A cluster whose points take part directly in the grid of `parent`: a leaf that has a grid, or a largest cluster that has none.
  struct Block {
    ClusterId cluster;
    ClusterId parent;  ///< itself if it has a grid; the root has no grid either if it is the only block
  };

  void make_grids();
  void find_blocks(ClusterId cluster, ClusterId parent);
  [[nodiscard]] bool has_grid(ClusterId cluster) const { return grid_of_[cluster] != kNoGrid; }
  [[nodiscard]] GridBox box_of(ClusterId cluster) const { return grid_box(tree_[cluster].center, tree_[cluster].half); }
  [[nodiscard]] Eigen::Ref<const Eigen::MatrixX3d> points_of(ClusterId cluster) const;

  FarFieldOptions options_;
  ClusterTree tree_;
  InteractionLists lists_;
  ChebyshevBasis basis_;
  Eigen::MatrixX3d points_;               // in the tree's order
  std::vector<std::uint32_t> grid_of_;    // per cluster: the number of its grid, or kNoGrid
  std::vector<ClusterId> grid_clusters_;  // per grid
  std::array<Eigen::MatrixXd, 3> nodes_;  // per axis, a column a grid: coordinates of its points
  std::vector<Block> blocks_;
};

/// Memory that a FarField and one call of apply take at their largest, in bytes, for points on a surface (some per cent too much); without the
/// caller's own vectors.
double far_field_bytes(std::size_t points, const FarFieldOptions& options);

}  // namespace smopt::metrics
