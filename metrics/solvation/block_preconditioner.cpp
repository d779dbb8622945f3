#include "metrics/solvation/block_preconditioner.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>

namespace smopt::metrics {
namespace {

using Block = std::span<const std::uint32_t>;

/// The points of the largest clusters with at most so many, and pieces of leaves that have more.
std::vector<Block> blocks_up_to(const ClusterTree& tree, std::size_t largest) {
  std::vector<Block> blocks;
  for (ClusterId c = 0; c < tree.clusters().size();) {
    if (tree[c].size() > largest && !tree[c].is_leaf()) {
      ++c;
      continue;
    }
    const Block points = tree.points_of(c);
    for (std::size_t begin = 0; begin < points.size(); begin += largest)
      blocks.push_back(points.subspan(begin, std::min(largest, points.size() - begin)));
    c = tree[c].past;
  }
  return blocks;
}

}  // namespace

BlockPreconditioner::BlockPreconditioner(const ClusterTree& tree, std::size_t largest, const BlockOf& block_of)
    : blocks_(blocks_up_to(tree, largest)), inverses_(blocks_.size()) {
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) { inverses_[b] = block_of(blocks_[b]).inverse().cast<float>(); });
}

Eigen::VectorXd BlockPreconditioner::solve(const Eigen::VectorXd& right_side) const {
  const auto n = right_side.size() / 2;
  Eigen::VectorXd solution(right_side.size());
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
    const Block points = blocks_[b];
    Eigen::VectorXd of_block(2 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      of_block[static_cast<Eigen::Index>(2 * i)] = right_side[points[i]];
      of_block[static_cast<Eigen::Index>(2 * i + 1)] = right_side[n + points[i]];
    }
    of_block = (inverses_[b].cast<double>() * of_block).eval();
    for (std::size_t i = 0; i < points.size(); ++i) {
      solution[points[i]] = of_block[static_cast<Eigen::Index>(2 * i)];
      solution[n + points[i]] = of_block[static_cast<Eigen::Index>(2 * i + 1)];
    }
  });
  return solution;
}

}  // namespace smopt::metrics
