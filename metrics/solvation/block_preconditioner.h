#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "metrics/solvation/cluster_tree.h"

namespace smopt::metrics {

/// Block-diagonal preconditioning of a system with two unknowns a point (the first of all points, then the second): a block is what couples the points of
/// one cluster, and is solved exactly (Chen & Geng 2018, J. Comput. Phys. 373:750).
class BlockPreconditioner {
 public:
  /// The 2 × 2 couplings of a block: of points[i] with points[j] in rows 2i and 2i + 1, columns 2j and 2j + 1.
  using BlockOf = std::function<Eigen::MatrixXd(std::span<const std::uint32_t> points)>;

  /// \param largest  points in a block, at least 1; the largest clusters that have no more are taken, and leaves that have more are cut.
  /// The tree must outlive this.
  /// Cost: O(n·largest²) time and 16·n·largest bytes; all cores.
  BlockPreconditioner(const ClusterTree& tree, std::size_t largest, const BlockOf& block_of);

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

 private:
  std::vector<std::span<const std::uint32_t>> blocks_;
  std::vector<Eigen::MatrixXf> inverses_;  // applied in double precision, so that what is done to a vector is linear
};

}  // namespace smopt::metrics
