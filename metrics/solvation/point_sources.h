#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "metrics/solvation/cluster_tree.h"
#include "metrics/solvation/pair_sums.h"
#include "smopt/geometry/vec3.h"

namespace smopt::metrics {

struct ChargeAndDipole {
  double charge = 0;
  Vec3 dipole = Vec3::Zero();
};
struct PotentialAndGradient {
  double potential = 0;
  Vec3 gradient = Vec3::Zero();
};
/// Of one point, for the kernels kPlain and kScreened.
using PointSources = std::array<ChargeAndDipole, kKernels>;
using PointFields = std::array<PotentialAndGradient, kKernels>;

/// A number and a vector for each of some points: charges and dipoles, or potentials and gradients.
struct PointMoments {
  Eigen::VectorXd number;
  Eigen::MatrixX3d vector;  ///< a row each
};

/// The points' coordinates in the tree's order, a row each.
Eigen::MatrixX3d in_tree_order(const ClusterTree& tree, const std::vector<Vec3>& points);

/// Sources in the tree's order, as `add_pair_sums` reads them; with the kernels' factor 1/4π.
class TreeSources {
 public:
  TreeSources(const ClusterTree& tree, const std::vector<PointSources>& sources);

  [[nodiscard]] const PointMoments& operator[](std::size_t kernel) const { return moments_[kernel]; }
  /// Those of a cluster. \param points  as `in_tree_order` gives them; must outlive the view.
  [[nodiscard]] SourceView view(const Cluster& cluster, const Eigen::MatrixX3d& points) const;

 private:
  std::array<PointMoments, kKernels> moments_;
};

/// Lanes for targets whose coordinates come from `coordinate(i, axis)`; sums are 0.
template <class Coordinate>
std::vector<TargetLanes> lanes_for(std::size_t count, const Coordinate& coordinate) {
  std::vector<TargetLanes> lanes((count + kTargetLanes - 1) / kTargetLanes);
  for (std::size_t i = 0; i < lanes.size() * kTargetLanes; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      lanes[i / kTargetLanes].position[axis][i % kTargetLanes] =
          coordinate(static_cast<Eigen::Index>(i < count ? i : count - 1), static_cast<Eigen::Index>(axis));
  return lanes;
}

/// Lanes for the points of a cluster.
std::vector<TargetLanes> lanes_of(const Cluster& cluster, const Eigen::MatrixX3d& points);

/// Adds what the lanes have gathered to the fields of the cluster's points.
void add_to_fields(const std::vector<TargetLanes>& lanes, std::span<const std::uint32_t> points, std::vector<PointFields>& fields);

}  // namespace smopt::metrics
